// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The first picture of a scene: traced before the light field, without a display.
 */
#ifndef cslfScenePicture_h
#define cslfScenePicture_h

#include <string>

namespace cslf::tool
{
class Scene;
class SceneOptions;

/// Traces a view that the scene fills, over a dark background, and writes it as a PNG that
/// RequireReplaceable recognizes. Throws a Failure, also if another file exists by then which must
/// not be replaced.
void WriteScenePicture(const std::string& fileName, const SceneOptions& options, const Scene& scene,
  bool replacesOthers);

/// Throws a Failure if a file exists, unless WriteScenePicture has made it.
void RequireReplaceable(const std::string& fileName);
}

#endif
