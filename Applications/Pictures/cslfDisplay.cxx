// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The X server that some builds of VTK need, also off screen.
#include "cslfPictures.h"

#ifdef CSLF_NEEDS_X_SERVER
#include "Console/cslfMessages.h"

#include <X11/Xauth.h>
#include <X11/Xlib.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

namespace cslf::tool
{
namespace
{
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// The screen of a virtual server. Pictures may be larger: they are drawn into buffers.
constexpr const char* Screen = "1280x1024x24";

/// The key to a server of our own, which other users of the computer do not have.
class Cookie
{
public:
  Cookie()
    : Stored(std::tmpfile(), std::fclose)
  {
    std::random_device random;
    for (char& byte : this->Bytes)
    {
      byte = static_cast<char>(random());
    }
    char name[] = "MIT-MAGIC-COOKIE-1";
    Xauth entry{};
    entry.family = FamilyWild;
    entry.name = name;
    entry.name_length = sizeof(name) - 1;
    entry.data = this->Bytes;
    entry.data_length = sizeof(this->Bytes);
    if (!this->Stored || !XauWriteAuth(this->Stored.get(), &entry) ||
      std::fflush(this->Stored.get()) != 0)
    {
      throw Failure("Drawing needs a temporary file, which cannot be made.");
    }
    XSetAuthorization(name, sizeof(name) - 1, this->Bytes, sizeof(this->Bytes));
  }

  int GetFile() const { return fileno(this->Stored.get()); }

private:
  char Bytes[16];
  File Stored; ///< has no name, so that nothing is left when the process is killed
};

/// Displays below are those of people and of xvfb-run. Programs that look for graphics cards, such
/// as MPI's, try to open them, and complain if they may not.
constexpr int FirstDisplay = 200;
constexpr int LastDisplay = 299;

/// The exit code of a child that found no server.
constexpr int NotFound = 127;

/// How long a server may take until it is ready.
constexpr int AnswerMilliseconds = 60000;

/// Xvfb as a child process. It ends with this one, however that ends.
class VirtualServer
{
public:
  VirtualServer()
  {
    int display = FirstDisplay;
    while (!this->Start(display))
    {
      // Another server may have the display.
      const bool isMissing = this->Process < 0 || this->Stop() == NotFound;
      if (isMissing || ++display > LastDisplay)
      {
        throw Failure(
          "Drawing needs an X server, and there is no DISPLAY. It starts Xvfb by itself "
          "where that is installed (on Debian, the package xvfb).");
      }
    }
    ::setenv("DISPLAY", (":" + std::to_string(display)).c_str(), 1);
  }

  ~VirtualServer() { this->Stop(); }
  VirtualServer(const VirtualServer&) = delete;
  VirtualServer& operator=(const VirtualServer&) = delete;

private:
  /// Starts the child, and waits until the server is ready. Returns false if it is none.
  bool Start(int display)
  {
    int ends[2];
    if (::pipe(ends) != 0)
    {
      throw Failure("Drawing needs a pipe, which cannot be made.");
    }
    const std::string name = ":" + std::to_string(display);
    const std::string number = std::to_string(ends[1]);
    const std::string key = "/dev/fd/" + std::to_string(this->Key.GetFile());
    const pid_t parent = ::getpid();
    this->Process = ::fork();
    if (this->Process == 0)
    {
      Become(parent, name.c_str(), number.c_str(), key.c_str());
    }
    ::close(ends[1]);
    const File answer(::fdopen(ends[0], "r"), std::fclose);
    if (this->Process < 0)
    {
      return false;
    }
    pollfd ready{ ends[0], POLLIN, 0 };
    if (::poll(&ready, 1, AnswerMilliseconds) == 0)
    {
      ::kill(this->Process, SIGKILL);
      this->Stop();
      throw Failure("Drawing needs an X server, and the program Xvfb does not answer.");
    }
    // The server writes its number when it is ready. Without a server there is only the end.
    int written = -1;
    return std::fscanf(answer.get(), "%d", &written) == 1;
  }

  /// In the child, which may only call what signals may call.
  [[noreturn]] static void Become(
    pid_t parent, const char* display, const char* number, const char* key)
  {
    // Ctrl+C is for the parent.
    ::setpgid(0, 0);
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent)
    {
      ::_exit(EXIT_FAILURE);
    }
#else
    static_cast<void>(parent);
#endif
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(nothing, STDERR_FILENO);
    // With -terminate, the server also ends when its last client is gone.
    ::execlp("Xvfb", "Xvfb", display, "-displayfd", number, "-auth", key, "-screen", "0", Screen,
      "-nolisten", "tcp", "-terminate", nullptr);
    ::_exit(NotFound);
  }

  /// Ends the child and returns its exit code, or -1 if it has none.
  int Stop()
  {
    int status = -1;
    if (this->Process > 0)
    {
      ::kill(this->Process, SIGTERM);
      ::waitpid(this->Process, &status, 0);
      this->Process = -1;
    }
    return status != -1 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Cookie Key;
  pid_t Process = -1;
};

using Connection = std::unique_ptr<Display, int (*)(Display*)>;

Connection Connect()
{
  return { XOpenDisplay(nullptr), XCloseDisplay };
}
}

void RequireDisplay(bool isVisible)
{
  // Kept until the end: a server that loses its last client restarts or ends, and breaks
  // connections that are made at that moment.
  static std::unique_ptr<VirtualServer> server;
  static Connection connection = Connect();
  if (!connection && isVisible)
  {
    throw Failure("A window needs a display, and there is none: set DISPLAY, or write a picture by "
                  "--screenshot.");
  }
  if (!connection)
  {
    server = std::make_unique<VirtualServer>();
    connection = Connect();
  }
  if (!connection)
  {
    throw Failure("Drawing needs an X server, and the one that was started does not answer.");
  }
}
}
#else
namespace cslf::tool
{
void RequireDisplay(bool) {}
}
#endif
