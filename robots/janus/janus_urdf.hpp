// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::janus {

/// The text of janus.urdf.
extern const char* const kJanusUrdf;

}  // namespace armature::janus
