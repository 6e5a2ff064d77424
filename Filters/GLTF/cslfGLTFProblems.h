// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Collects what is invalid or not supported in a glTF file.
 */
#ifndef cslfGLTFProblems_h
#define cslfGLTFProblems_h

#include "cslfGLTFValue.h"
#include "cslfJoin.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace cslf
{
class GLTFProblems
{
public:
  std::set<std::string> Omitted; ///< names of unsupported features

  /// Does a part of the work. Records a GLTFError in it, and continues.
  template <typename Work>
  void Attempt(const Work& work)
  {
    try
    {
      work();
    }
    catch (const GLTFError& error)
    {
      this->Add(error.what());
    }
  }

  /// Adds an error, once.
  void Add(const std::string& error)
  {
    if (this->Known.insert(error).second && this->Errors.size() < MostErrors)
    {
      this->Errors.push_back(error);
    }
  }

  /// Records an unsupported feature, if the file has it.
  void Omit(bool present, const char* what)
  {
    if (present)
    {
      this->Omitted.insert(what);
    }
  }

  /// The first errors in the file, in the order in which they were found.
  std::string ListErrors() const
  {
    const std::string text = Join(this->Errors, "; ");
    const std::size_t more = this->Known.size() - this->Errors.size();
    return more > 0 ? text + "; and " + std::to_string(more) + " more" : text;
  }

private:
  static constexpr std::size_t MostErrors = 4;

  std::vector<std::string> Errors;
  std::set<std::string> Known;
};
}

#endif
