// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Colour of bytes to video frames and back, 4 bytes a texel, as planar RGB or as Y'CbCr of ITU-R
 * BT.709's matrix; see cslfColorRows.h.
 */
#ifndef cslfColorFrames_h
#define cslfColorFrames_h

#include "Coding/cslfAV.h"
#include "vtkCSLFModule.h"

namespace cslf
{
/// Fills a writable frame with red, green and blue. Chroma of fewer samples lies above the even
/// ones of luma (AVCHROMA_LOC_LEFT) and mixes no texels of different tiles, `tile` of which are
/// side by side in a row. The frame's range is narrow where it says so.
VTKCSLF_EXPORT void PutColors(const unsigned char* colors, int tile, AVFrame* frame);

/// Sets red, green and blue from a frame of full range whose samples have that format, and of which
/// chroma, where it has fewer, lies at AVCHROMA_LOC_LEFT or else at AVCHROMA_LOC_CENTER. Every
/// fourth byte is written, too.
VTKCSLF_EXPORT void TakeColors(const AVFrame* frame, AVPixelFormat format,
  AVChromaLocation location, int tile, unsigned char* colors);
}

#endif
