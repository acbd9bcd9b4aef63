// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace armature::foxglove::internal {

// Foxglove's own schemas, as far as they are filled here
// (https://github.com/foxglove/foxglove-sdk/tree/main/schemas/jsonschema).

inline constexpr const char* kTransformsName = "foxglove.FrameTransforms";
inline constexpr const char* kSceneName = "foxglove.SceneUpdate";

/// Of foxglove.FrameTransforms.
std::string transforms_schema();
/// Of foxglove.SceneUpdate.
std::string scene_schema();

}  // namespace armature::foxglove::internal
