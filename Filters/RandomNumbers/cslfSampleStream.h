// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The random numbers of one path: a scrambled low-discrepancy sequence for every pair of dimensions
 * of every texel.
 */
#ifndef cslfSampleStream_h
#define cslfSampleStream_h

#include <glm/vec2.hpp>

#include <cstdint>

#include "SIMD/cslfLanes.h"

namespace cslf
{
/// The numbers for a path's vertex. Each vertex has its own set.
enum class Dimension : std::uint32_t
{
  Pixel,       ///< the position in the texel, once per path; at later vertices, places in volumes
  Lobe,        ///< which part of the BSDF
  Direction,   ///< the direction of the BSDF's sample
  LocalLight,  ///< the choice of a light at a finite distance, and of its point
  Environment, ///< the direction to the environment
  Roulette,    ///< whether the path continues
  Count
};

/// Mixes two numbers to one without visible pattern (the finaliser of splitmix64).
inline std::uint64_t MixBits(std::uint64_t a, std::uint64_t b)
{
  std::uint64_t x = a + 0x9e3779b97f4a7c15u * (b + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/**
 * Sample `index` of a texel. The samples of a texel are, in every pair of dimensions, an
 * Owen-scrambled (0,2)-sequence, the first two dimensions of Sobol's; the pairs are decorrelated by
 * shuffling the index. Scrambling and shuffling are hashes of the seed, the texel and the dimension
 * alone, so a texel gets the same numbers whatever is traced beside it. Burley, "Practical
 * Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash itself is by Laine and Karras, with
 * Vegdahl's constants.
 */
class SampleStream
{
public:
  /// What identifies a texel: the seed and its absolute position in the image data.
  static std::uint64_t HashTexel(std::uint32_t seed, int z, int x, int y)
  {
    return HashRow(HashColumn(HashSlice(seed, z), x), y);
  }

  /// The same in steps.
  static std::uint64_t HashSlice(std::uint32_t seed, int z) { return MixBits(seed, z); }
  static std::uint64_t HashColumn(std::uint64_t slice, int x) { return MixBits(slice, x); }
  static std::uint64_t HashRow(std::uint64_t column, int y) { return MixBits(column, y); }

  SampleStream(std::uint64_t texelHash, std::uint32_t index)
    : TexelHash(texelHash)
    , Index(index)
  {
  }

  /// Advances to the numbers of the path's next vertex.
  void NextVertex() { this->Vertex += static_cast<std::uint32_t>(Dimension::Count); }

  /// Two numbers in [0,1).
  glm::vec2 Get2D(Dimension dimension) const
  {
    const Scramble scramble = MakeScramble(this->TexelHash, dimension, this->Vertex);
    glm::vec2 point;
    Get2D(this->Index, scramble, point.x, point.y);
    return point;
  }

  /// The number that makes the pair of dimensions of a texel unique.
  struct Scramble
  {
    std::uint32_t Low;
    std::uint32_t High;
  };

  static Scramble MakeScramble(
    std::uint64_t texelHash, Dimension dimension, std::uint32_t vertex = 0)
  {
    const std::uint64_t hash = MixBits(texelHash, vertex + static_cast<std::uint32_t>(dimension));
    return { static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32) };
  }

  static void Get2D(std::uint32_t sample, const Scramble& scramble, float& x, float& y)
  {
    const std::uint32_t index =
      ReverseBits(ScrambleReversed(ReverseBits(sample), scramble.Low ^ scramble.High));
    x = ToUnit(ReverseBits(ScrambleReversed(index, scramble.Low)));
    y = ToUnit(ReverseBits(ScrambleReversed(MultiplyByPascal(index), scramble.High)));
  }

  /// One number in [0,1).
  float Get1D(Dimension dimension) const { return this->Get2D(dimension).x; }

private:
  static std::uint32_t ReverseBits(std::uint32_t x)
  {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
  }

  /// Owen scrambling of a number whose bits are reversed: each bit is flipped depending on the ones
  /// below it.
  static std::uint32_t ScrambleReversed(std::uint32_t x, std::uint32_t seed)
  {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
  }

  /// Sobol's second dimension with its bits reversed. Its generator matrix is Pascal's triangle
  /// modulo 2; the binomial (k over j) is odd where j's bits are among k's, so each bit of the
  /// result sums those of its supersets.
  static std::uint32_t MultiplyByPascal(std::uint32_t x)
  {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ (x >> 16);
  }

  /// The upper 24 bits, all that a float below 1 can hold.
  static float ToUnit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

  std::uint64_t TexelHash;
  std::uint32_t Index;
  std::uint32_t Vertex = 0; // the first of its dimensions
};

struct StreamLanes
{
  Lanes<std::uint64_t> Hash;  ///< of the path's texel
  Lanes<std::uint32_t> Index; ///< of the texel's samples

  /// The numbers of each path's vertex, like SampleStream::Get2D. Vertices are numbered from 0.
  void Get2D(std::uint32_t vertex, Dimension dimension, Lanes<float>& x, Lanes<float>& y) const;

  /// Only the first number, like SampleStream::Get1D.
  void Get1D(std::uint32_t vertex, Dimension dimension, Lanes<float>& x) const;
};
}

#endif
