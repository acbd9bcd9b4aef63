// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <mujoco/mujoco.h>

#include "armature/base/result.hpp"

namespace armature::sim::internal {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, DeleteModel>;
using Data = std::unique_ptr<mjData, DeleteData>;

/// The text of a URDF or MJCF as a model, or what is wrong with it.
/// @param name  what errors call the text
/// @param kind  what it is expected to be, such as "a URDF"
base::Result<Model> compile(const std::string& text, const std::string& name,
                            std::string_view kind);

/// Empty if it has none.
std::string_view name_of(const mjModel& model, mjtObj kind, int index);

/// Whether MuJoCo had nothing to warn of and everything is to be accelerated by numbers.
/// @rt nonblocking, no allocation
bool is_sound(const mjModel& model, const mjData& data);

}  // namespace armature::sim::internal
