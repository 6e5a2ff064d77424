// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Writes files and folders like a bake, in the current folder, and prints errors. Called with an
// argument it is the second process, which must not get the file.

#include "Coding/Reading/cslfBackgroundThread.h"
#include "Files/cslfAtomicFile.h"
#include "Files/cslfFileSystem.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace
{
// With a letter outside ASCII, in UTF-8.
const std::string FileName = "m\xc3\xa4rz.txt";
const std::string FolderName = "folder";

int Errors = 0;

void Check(bool isRight, const std::string& what, const std::string& error = {})
{
  if (!isRight)
  {
    std::cout << "Wrong: " << what << ": " << error << "\n";
    ++Errors;
  }
}

std::string Read(const std::string& name)
{
  std::ifstream file(cslf::ToPath(name));
  std::string text;
  std::getline(file, text);
  return text;
}

void Write(const std::string& name, const std::string& text)
{
  std::ofstream(cslf::ToPath(name)) << text;
}

bool IsFree()
{
  std::string error;
  return cslf::AtomicFile(FileName).Open(error);
}

void WriteFile(const std::string& text, const std::string& program)
{
  std::string warning;
  std::string error;
  cslf::AtomicFile file(FileName);
  Check(file.Open(error), "open", error);
  Check(!IsFree(), "a second writer in the process");
  Check(std::system((program + " second").c_str()) == 0, "a second writer in another process");
  Write(file.GetTemporaryName(), text);
  Check(file.Publish(warning, error) && warning.empty(), "publish", warning + error);
  Check(Read(FileName) == text, "the file's text", Read(FileName));
}

void KeepFile()
{
  const std::string text = Read(FileName);
  std::string warning;
  std::string error;
  cslf::AtomicFile file(FileName);
  Check(file.Open(error), "open", error);
  Write(file.GetTemporaryName(), "another");
  Check(!file.Publish(warning, error, false) && error == cslf::NameIsTaken,
    "publish where a file is", error);
  Check(Read(FileName) == text, "the text of the file that stays", Read(FileName));
}

void WriteFolder(const std::string& text)
{
  std::string warning;
  std::string error;
  cslf::AtomicFolder folder(FolderName, cslf::ListFolder);
  Check(folder.Open("texts", error), "open the folder", error);
  Write(folder.GetTemporaryName() + "/a", text);
  Check(folder.Publish(warning, error) && warning.empty(), "publish the folder", warning + error);
  Check(Read(FolderName + "/a") == text, "the text in the folder", Read(FolderName + "/a"));
}
}

int main(int argc, char* argv[])
{
  if (argc > 1)
  {
    return IsFree() ? 1 : 0;
  }
  cslf::LowerThreadPriority();
  for (const char* text : { "first", "second" })
  {
    WriteFile(text, argv[0]);
    WriteFolder(text);
  }
  KeepFile();
  std::string error;
  const std::vector<std::string> names = cslf::ListFolder(".");
  Check(names == std::vector<std::string>{ FolderName, FileName }, "other files stayed",
    names.empty() ? "" : names.back());
  Check(cslf::IsWritableFolder(".", error), "this folder", error);
  Check(!cslf::IsWritableFolder("nowhere", error), "a missing folder");
  Check(!cslf::MakeFile(FileName, "x", 1, error), "a file that is there");
  Check(cslf::GetFreeBytes("nowhere/nothing") > 0.0, "free bytes");
  Check(!cslf::DescribeProcess().empty(), "the process's name");
  return Errors == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
