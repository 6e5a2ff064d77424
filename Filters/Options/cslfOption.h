// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rows of the table of options, see Options/cslfOptionTable.h.
 */
#ifndef cslfOption_h
#define cslfOption_h

#include <vtkObject.h>
#include <vtkSetGet.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>
#include <string>

namespace cslf
{
struct QualityPreset
{
  int Samples;           ///< of a texel
  double NoiseTarget;    ///< of a texel
  double CacheTolerance; ///< of vtkCSLFRadianceCacheOptions
  int CacheSamples;      ///< of a point of the cache
  double CacheSpacing;   ///< relative to the one that depends on the size of the picture
  const char* Coding;    ///< the preset of vtkCSLFEncoder
};

/// In the order of vtkCSLFPathTracer::Qualities.
constexpr QualityPreset QualityPresets[] = {
  { 4, 0.02, 1.0 / 16.0, 32, 4.0, "ultrafast" },
  { 32, 0.004, 1.0 / 64.0, 512, 1.0, "slow" },
  { 256, 0.001, 1.0 / 256.0, 4096, 1.0, "slow" },
};

/// The preset of an encoder: the one that is set or, if that is "auto", that of the quality of what
/// it codes. Null is an empty name.
inline std::string ChoosePreset(const char* preset, int quality)
{
  const std::string name = preset ? preset : "";
  return name == "auto" ? QualityPresets[quality].Coding : name;
}

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

  /// The nearest number of the range. What is no number remains so.
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

/// A text, for which some values are suggested: "first, second".
struct TextOption : Option<const char*>
{
  const char* Suggestions;
};

/// The number to be used for a parameter of a vtkObject that was given: the nearest of its range,
/// or the present one if it is no number. If that is another one than given, the object warns.
template <typename T>
T Clamp(vtkObject* self, const char* name, T value, T minimum, T maximum, T present)
{
  const bool isNumber = value == value;
  const T used = !isNumber ? present
    : value < minimum      ? minimum
    : value > maximum      ? maximum
                           : value;
  if (used != value)
  {
    vtkWarningWithObjectMacro(self, << name << " must be " << (isNumber ? "" : "a number ")
                                    << "from " << minimum << " to " << maximum << ": " << used
                                    << " is used instead of " << value << ".");
  }
  return used;
}

/// Sets a member of a vtkObject to a number of its range, with a warning if another was given.
template <typename Object, typename T>
void SetClamped(Object* self, const char* name, T& member, T value, T minimum, T maximum)
{
  value = Clamp(self, name, value, minimum, maximum, member);
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

/// Defines a setter of a vtkObject with a range. Others are clamped, with a warning.
#define cslfSetClampMacro(Class, Name, Minimum, Maximum)                                           \
  void Class::Set##Name(decltype(Name) value)                                                      \
  {                                                                                                \
    cslf::SetClamped<Class, decltype(Name)>(this, #Name, this->Name, value, Minimum, Maximum);     \
  }                                                                                                \
  static_assert(true, "a semicolon follows")

/// The same with the range of a row of the table.
#define cslfSetOptionMacro(Class, Name, Row)                                                       \
  cslfSetClampMacro(Class, Name, cslf::options::Row.Minimum, cslf::options::Row.Maximum)

#endif
