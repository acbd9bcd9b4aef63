// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/world.hpp"

#include <algorithm>
#include <utility>

#include <mujoco/mujoco.h>

#include "armature/base/seconds.hpp"
#include "armature/sim/internal/mujoco_model.hpp"

namespace armature::sim {

struct World::Impl {
  internal::Model model;
  internal::Data data;
  base::Duration inner_step{};
  base::Duration time{};
  base::Duration owed{};  // less than an inner step
  PlantStatus status = PlantStatus::kGood;

  void inner();
};

/// The two halves of mj_step, which would begin anew on its own where a number is not finite.
void World::Impl::inner() {
  mj_forward(model.get(), data.get());
  if (!internal::is_sound(*model, *data)) {
    status = PlantStatus::kDiverged;
    return;
  }
  mj_Euler(model.get(), data.get());
  time += inner_step;
}

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

base::Result<World> World::parse(const std::string& mjcf, const std::string& name,
                                 const Options& options) {
  if (options.inner_step <= base::Duration{}) {
    return base::Error{name + ": inner_step is " + std::to_string(options.inner_step.count()) +
                       " ns, expected more than 0"};
  }
  auto compiled = internal::compile(mjcf, name, "an MJCF description");
  if (!compiled) return base::Error{compiled.error()};
  auto impl = std::make_unique<Impl>();
  impl->model = std::move(compiled).value();
  impl->inner_step = options.inner_step;
  impl->model->opt.timestep = base::to_seconds(options.inner_step);
  impl->data.reset(mj_makeData(impl->model.get()));
  mj_forward(impl->model.get(), impl->data.get());
  return World(std::move(impl));
}

std::optional<std::size_t> World::find_joint(std::string_view name) const {
  const mjModel& model = *impl_->model;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    if (type != mjJNT_HINGE && type != mjJNT_SLIDE) continue;
    if (internal::name_of(model, mjOBJ_JOINT, joint) == name) {
      return static_cast<std::size_t>(joint);
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> World::find_body(std::string_view name) const {
  const int body = mj_name2id(impl_->model.get(), mjOBJ_BODY, std::string(name).c_str());
  if (body < 0) return std::nullopt;
  return static_cast<std::size_t>(body);
}

double World::position(std::size_t joint) const {
  return impl_->data->qpos[impl_->model->jnt_qposadr[joint]];
}

double World::velocity(std::size_t joint) const {
  return impl_->data->qvel[impl_->model->jnt_dofadr[joint]];
}

void World::set_effort(std::size_t joint, double effort) {
  impl_->data->qfrc_applied[impl_->model->jnt_dofadr[joint]] = effort;
}

Pose World::pose(std::size_t body) const {
  Pose pose;
  std::copy_n(impl_->data->xpos + 3 * body, 3, pose.position.begin());
  std::copy_n(impl_->data->xquat + 4 * body, 4, pose.orientation.begin());
  return pose;
}

bool World::place(std::size_t body, const Pose& pose) {
  const mjModel& model = *impl_->model;
  const int joint = model.body_jntadr[body];
  if (joint < 0 || model.jnt_type[joint] != mjJNT_FREE) return false;
  mjtNum* const position = impl_->data->qpos + model.jnt_qposadr[joint];
  std::copy(pose.position.begin(), pose.position.end(), position);
  std::copy(pose.orientation.begin(), pose.orientation.end(), position + 3);
  std::fill_n(impl_->data->qvel + model.jnt_dofadr[joint], 6, 0.0);
  mj_kinematics(impl_->model.get(), impl_->data.get());
  return true;
}

PlantStatus World::step(base::Duration dt) {
  impl_->owed += dt;
  while (impl_->owed >= impl_->inner_step && impl_->status == PlantStatus::kGood) {
    impl_->inner();
    impl_->owed -= impl_->inner_step;
  }
  return impl_->status;
}

PlantStatus World::status() const { return impl_->status; }
base::Duration World::time() const { return impl_->time; }
base::Duration World::inner_step() const { return impl_->inner_step; }

}  // namespace armature::sim
