// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rows of the table of options, see Options/cslfOptionTable.h.
 */
#ifndef cslfOption_h
#define cslfOption_h

#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>

namespace cslf
{
/// An option without range: a switch, a text or a vector.
template <typename T>
struct Option
{
  const char* Name;
  T Default;
  const char* Help; ///< a sentence without capital letter and full stop
  const char* Key;  ///< in JSON; empty if it is not written
  const char* Flag; ///< of the command-line tool, or empty
};

/// A number with a range.
template <typename T>
struct NumberOption
{
  const char* Name;
  T Default;
  T Minimum;
  T Maximum;
  const char* Help;
  const char* Key;
  const char* Flag;

  constexpr T Clamp(T value) const
  {
    return value < this->Minimum ? this->Minimum : value > this->Maximum ? this->Maximum : value;
  }
};

/// A choice. In JSON and on the command line, values have names.
template <std::size_t Count>
struct EnumOption : NumberOption<int>
{
  std::array<const char*, Count> Names;
};

/// Sets a member of a vtkObject as vtkSetClampMacro does, with the range of an option.
template <typename Object, typename T>
void SetClamped(Object* self, T& member, T value, const NumberOption<T>& option)
{
  value = option.Clamp(value);
  if (member != value)
  {
    member = value;
    self->Modified();
  }
}

/// Sets an object's options. They are never null: null selects new ones with the default values.
template <typename Object, typename Options>
void SetOptions(Object* self, vtkSmartPointer<Options>& member, Options* options)
{
  if (member != options)
  {
    member = options;
    if (!member)
    {
      member = vtkSmartPointer<Options>::New();
    }
    self->Modified();
  }
}
}

/// Defines a setter of a vtkObject with the range of a row of the table.
#define cslfSetOptionMacro(Class, Name, Row)                                                       \
  void Class::Set##Name(decltype(Name) value)                                                      \
  {                                                                                                \
    cslf::SetClamped(this, this->Name, value, cslf::options::Row);                                 \
  }

#endif
