// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The samples of a viewpoint.
 */
#ifndef cslfViewpointSamples_h
#define cslfViewpointSamples_h

#include "cslfChannel.h"
#include "cslfColor.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkTypeTraits.h>

#include <array>
#include <cstddef>

class vtkImageData;

namespace cslf
{
/// The samples of one viewpoint: a strip of 5 N x N texels of each known channel of each layer. The
/// arrays may contain more viewpoints. Copies share them, so samples are changed only while nobody
/// else reads them. Loops over texels use the pointers that Get returns.
class VTKCSLF_EXPORT ViewpointSamples
{
public:
  /// No samples.
  ViewpointSamples() = default;

  /// The first viewpoint of image data whose values lie in memory tuple by tuple.
  explicit ViewpointSamples(vtkImageData* image);

  /// The viewpoint of the same arrays that begins at a tuple.
  ViewpointSamples At(vtkIdType first) const;

  /// Whether there are no samples, for instance because the viewpoint is damaged.
  bool IsEmpty() const;

  ///@{
  /// A channel's array, or null. The first one set becomes the active one of an image.
  void SetArray(ChannelId id, vtkDataArray* array) { this->ArrayOf(id) = array; }
  vtkDataArray* GetArray(ChannelId id) const { return this->Arrays[id.GetPlace()]; }
  void AddTo(vtkImageData* image) const;
  ///@}

  /// The viewpoint's first tuple in the arrays.
  vtkIdType GetFirst() const { return this->First; }

  /// The memory of a channel's samples, or null.
  void* GetMemory(ChannelId id) const;

  /// The samples of a channel, or null if it does not have that type.
  template <typename Value>
  Value* Get(ChannelId id) const
  {
    vtkDataArray* array = this->GetArray(id);
    const bool fits = array && array->GetDataType() == vtkTypeTraits<Value>::VTKTypeID();
    return fits ? static_cast<Value*>(this->GetMemory(id)) : nullptr;
  }

  /// Copies a number of texels to arrays of the same types.
  void CopyTo(const ViewpointSamples& target, std::size_t texels) const;

private:
  vtkSmartPointer<vtkDataArray>& ArrayOf(ChannelId id) { return this->Arrays[id.GetPlace()]; }

  std::array<vtkSmartPointer<vtkDataArray>, ChannelIdCount> Arrays;
  vtkIdType First = 0;
};

/// The colours of a layer of a viewpoint, bytes or floats. The samples must outlive this object.
class VTKCSLF_EXPORT ColorTexels
{
public:
  explicit ColorTexels(const ViewpointSamples& samples, int layer = 0)
    : Bytes(samples.Get<unsigned char>({ KnownChannel::Color, layer }))
    , Floats(samples.Get<float>({ KnownChannel::Color, layer }))
  {
  }

  bool AreFloats() const { return this->Floats != nullptr; }

  /// Red, green or blue as displayed over black, from 0 to 255; floats at that multiple of the
  /// exposure.
  double GetShown(std::size_t texel, int component, double exposure = 1.0) const
  {
    const std::size_t place = 4 * texel + component;
    return this->Floats ? ToByte(LinearToSRGB(exposure * this->Floats[place])) : this->Bytes[place];
  }

  /// Alpha as a byte.
  unsigned char GetCoverage(std::size_t texel) const
  {
    return this->Floats ? ToByte(this->Floats[4 * texel + 3]) : this->Bytes[4 * texel + 3];
  }

private:
  const unsigned char* Bytes;
  const float* Floats;
};
}

#endif
