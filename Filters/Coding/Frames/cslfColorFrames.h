// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts byte colour, 4 bytes per texel, to video frames and back, as planar RGB or as Y'CbCr
 * with the matrix of ITU-R BT.709; see cslfColorRows.h.
 */
#ifndef cslfColorFrames_h
#define cslfColorFrames_h

#include "Coding/Codecs/cslfAV.h"
#include "vtkCSLFModule.h"

namespace cslf
{
/// Fills a writable frame with red, green and blue. Subsampled chroma lies above the even samples
/// of luma (AVCHROMA_LOC_LEFT) and does not mix texels of different tiles, which are `tile` texels
/// wide. The frame's range is narrow if its properties say so.
VTKCSLF_EXPORT void PutColors(const unsigned char* colors, int tile, AVFrame* frame);

/// Sets red, green and blue from a frame of full range and that format. Subsampled chroma lies at
/// AVCHROMA_LOC_LEFT or else at AVCHROMA_LOC_CENTER. Every fourth byte is written, too.
VTKCSLF_EXPORT void TakeColors(const AVFrame* frame, AVPixelFormat format,
  AVChromaLocation location, int tile, unsigned char* colors);
}

#endif
