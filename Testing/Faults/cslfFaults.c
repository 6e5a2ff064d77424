/* SPDX-FileCopyrightText: Copyright (c) CSLF contributors */
/* SPDX-License-Identifier: BSD-3-Clause */

/*
 * A library to preload: makes calls to the operating system fail that change files below the folder
 * CSLF_FAULT_ROOT. CSLF_FAULT says how, and CSLF_FAULT_AT at which call, counted from 1:
 *
 *   full        no call that needs room succeeds any more (ENOSPC)
 *   eio         one call that writes or waits for the disk fails (EIO)
 *   rename      one renaming fails (EIO)
 *   kill        the process is killed before the call
 *   noexchange  the file system cannot exchange names
 *   nolock      the file system has no locks (ENOLCK)
 *   count       none; CSLF_FAULT_LOG names the file for the numbers of calls
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

/* What a call does. */
enum Kind
{
  Room,   /* needs room on the disk */
  Sync,   /* waits for the disk */
  Naming, /* renames */
  Removal
};

static atomic_long Counts[4];

static const char* Setting(const char* name)
{
  const char* text = getenv(name);
  return text ? text : "";
}

static int IsFault(const char* kind)
{
  return strcmp(Setting("CSLF_FAULT"), kind) == 0;
}

static int IsWatchedPath(const char* path)
{
  const char* root = Setting("CSLF_FAULT_ROOT");
  char whole[4096];
  if (*root == '\0' || !path)
  {
    return 0;
  }
  if (path[0] != '/')
  {
    if (!getcwd(whole, sizeof(whole) / 2))
    {
      return 0;
    }
    strcat(whole, "/");
    strncat(whole, path, sizeof(whole) / 2 - 2);
    path = whole;
  }
  return strncmp(path, root, strlen(root)) == 0;
}

static int IsWatched(int file)
{
  char link[64];
  char path[4096];
  snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof(path) - 1);
  if (length <= 0)
  {
    return 0;
  }
  path[length] = '\0';
  return IsWatchedPath(path);
}

/* Counts a call. Whether it has to fail, with errno set. */
static int Fails(enum Kind kind)
{
  const long at = atol(Setting("CSLF_FAULT_AT"));
  const long number = atomic_fetch_add(&Counts[kind], 1) + 1;
  const long room = atomic_load(&Counts[Room]);
  const long syncs = atomic_load(&Counts[Sync]);
  if (IsFault("full") && kind == Room && number >= at)
  {
    errno = ENOSPC;
    return 1;
  }
  if (IsFault("eio") && (kind == Room || kind == Sync) && room + syncs == at)
  {
    errno = EIO;
    return 1;
  }
  if (IsFault("rename") && kind == Naming && number == at)
  {
    errno = EIO;
    return 1;
  }
  if (IsFault("kill") &&
    room + syncs + atomic_load(&Counts[Naming]) + atomic_load(&Counts[Removal]) == at)
  {
    kill(getpid(), SIGKILL);
  }
  return 0;
}

__attribute__((destructor)) static void Report(void)
{
  if (IsFault("count"))
  {
    FILE* log = fopen(Setting("CSLF_FAULT_LOG"), "w");
    if (log)
    {
      fprintf(
        log, "%ld %ld %ld %ld\n", Counts[Room], Counts[Sync], Counts[Naming], Counts[Removal]);
      fclose(log);
    }
  }
}

/* The function that is wrapped. */
#define NEXT(function) ((__typeof__(&(function)))dlsym(RTLD_NEXT, #function))

ssize_t write(int file, const void* bytes, size_t count)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(write)(file, bytes, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(pwrite)(file, bytes, count, offset);
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t offset)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(pwrite64)(file, bytes, count, offset);
}

ssize_t writev(int file, const struct iovec* pieces, int count)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(writev)(file, pieces, count);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file)
{
  return IsWatched(fileno(file)) && Fails(Room) ? 0 : NEXT(fwrite)(bytes, size, count, file);
}

int ftruncate(int file, off_t length)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(ftruncate)(file, length);
}

int ftruncate64(int file, off64_t length)
{
  return IsWatched(file) && Fails(Room) ? -1 : NEXT(ftruncate64)(file, length);
}

int fsync(int file)
{
  return IsWatched(file) && Fails(Sync) ? -1 : NEXT(fsync)(file);
}

int fdatasync(int file)
{
  return IsWatched(file) && Fails(Sync) ? -1 : NEXT(fdatasync)(file);
}

int syncfs(int file)
{
  return IsWatched(file) && Fails(Sync) ? -1 : NEXT(syncfs)(file);
}

int mkdir(const char* path, mode_t mode)
{
  return IsWatchedPath(path) && Fails(Room) ? -1 : NEXT(mkdir)(path, mode);
}

char* mkdtemp(char* path)
{
  return IsWatchedPath(path) && Fails(Room) ? NULL : NEXT(mkdtemp)(path);
}

int rename(const char* from, const char* to)
{
  return IsWatchedPath(to) && Fails(Naming) ? -1 : NEXT(rename)(from, to);
}

int renameat(int fromFolder, const char* from, int toFolder, const char* to)
{
  return IsWatchedPath(to) && Fails(Naming) ? -1 : NEXT(renameat)(fromFolder, from, toFolder, to);
}

int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned int flags)
{
  if (IsWatchedPath(to) && flags != 0 && IsFault("noexchange"))
  {
    errno = EINVAL;
    return -1;
  }
  return IsWatchedPath(to) && Fails(Naming)
    ? -1
    : NEXT(renameat2)(fromFolder, from, toFolder, to, flags);
}

int unlink(const char* path)
{
  return IsWatchedPath(path) && Fails(Removal) ? -1 : NEXT(unlink)(path);
}

int rmdir(const char* path)
{
  return IsWatchedPath(path) && Fails(Removal) ? -1 : NEXT(rmdir)(path);
}

int flock(int file, int operation)
{
  if (IsFault("nolock"))
  {
    errno = ENOLCK;
    return -1;
  }
  return NEXT(flock)(file, operation);
}

static mode_t GetMode(int flags, va_list arguments)
{
  return flags & O_CREAT ? (mode_t)va_arg(arguments, int) : 0;
}

#define WRAP_OPEN(function)                                                                        \
  int function(const char* path, int flags, ...)                                                   \
  {                                                                                                \
    va_list arguments;                                                                             \
    va_start(arguments, flags);                                                                    \
    const mode_t mode = GetMode(flags, arguments);                                                 \
    va_end(arguments);                                                                             \
    return (flags & O_CREAT) && IsWatchedPath(path) && Fails(Room)                                 \
      ? -1                                                                                         \
      : NEXT(function)(path, flags, mode);                                                         \
  }

WRAP_OPEN(open)
WRAP_OPEN(open64)

#define WRAP_FOPEN(function)                                                                       \
  FILE* function(const char* path, const char* mode)                                               \
  {                                                                                                \
    return strpbrk(mode, "wa") && IsWatchedPath(path) && Fails(Room) ? NULL                        \
                                                                     : NEXT(function)(path, mode); \
  }

WRAP_FOPEN(fopen)
WRAP_FOPEN(fopen64)
