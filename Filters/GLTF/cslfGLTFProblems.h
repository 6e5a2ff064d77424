// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What of a glTF file is not shown as the file has it.
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
  std::set<std::string> Omitted; ///< what cannot be represented, in words

  /// Does a part of the work. What is wrong with the file there is kept, and the rest goes on.
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

  /// Notes what cannot be represented, if it is there.
  void Omit(bool present, const char* what)
  {
    if (present)
    {
      this->Omitted.insert(what);
    }
  }

  /// What is wrong with the file: the first errors, in the order in which they were met.
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
