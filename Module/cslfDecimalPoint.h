// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbers in texts that other libraries read and print.
 */
#ifndef cslfDecimalPoint_h
#define cslfDecimalPoint_h

#include <clocale>
#ifdef _WIN32
#include <string>
#else
#include <locale.h>
#endif

namespace cslf
{
/// While it lives, functions of C such as strtod and printf use a decimal point on this thread. In
/// a program whose language has a decimal comma, FFmpeg would otherwise refuse "23.7", and
/// OpenImageIO would read 1.8 in the header of an image as 1.
class DecimalPoint
{
public:
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;
#ifdef _WIN32
  DecimalPoint()
    : WasPerThread(_configthreadlocale(_ENABLE_PER_THREAD_LOCALE))
    , Before(std::setlocale(LC_NUMERIC, nullptr))
  {
    std::setlocale(LC_NUMERIC, "C");
  }
  ~DecimalPoint()
  {
    std::setlocale(LC_NUMERIC, this->Before.c_str());
    _configthreadlocale(this->WasPerThread);
  }

private:
  int WasPerThread;
  std::string Before;
#else
  DecimalPoint()
    : Before(uselocale(GetPoint()))
  {
  }
  ~DecimalPoint()
  {
    uselocale(this->Before);
  }

private:
  /// The C locale is always there. It is never freed, because threads may use it.
  static locale_t GetPoint()
  {
    static const locale_t point = newlocale(LC_ALL_MASK, "C", nullptr);
    return point;
  }

  locale_t Before;
#endif
};
}

#endif
