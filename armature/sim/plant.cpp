// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/plant.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include <mujoco/mujoco.h>

#include "armature/base/seconds.hpp"
#include "armature/sim/internal/mujoco_model.hpp"

namespace armature::sim {
namespace {

using internal::Data;
using internal::Model;

std::string_view joint_name(const mjModel& model, int joint) {
  return internal::name_of(model, mjOBJ_JOINT, joint);
}

base::Result<void> check_joints(const mjModel& model, const std::string& name) {
  if (model.njnt == 0) return base::Error{name + ": no joint moves, expected at least one"};
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    if (type == mjJNT_HINGE || type == mjJNT_SLIDE) continue;
    return base::Error{name + ": joint '" + std::string(joint_name(model, joint)) +
                       "' has several degrees of freedom, expected revolute, continuous, "
                       "prismatic or fixed"};
  }
  return {};
}

base::Result<void> set_armature(mjModel& model, const std::string& name,
                                const std::map<std::string, double>& armature) {
  const auto mistake = [&name](const std::string& joint, const std::string& what) {
    return base::Error{name + ": the armature of joint '" + joint + "' " + what};
  };
  for (const auto& [joint, inertia] : armature) {
    const int id = mj_name2id(&model, mjOBJ_JOINT, joint.c_str());
    if (id < 0) return mistake(joint, "is given, but the description has no such joint that moves");
    if (!std::isfinite(inertia) || inertia < 0.0) {
      return mistake(joint, "is expected to be a finite number of at least 0");
    }
    model.dof_armature[model.jnt_dofadr[id]] = inertia;
  }
  return {};
}

/// Where the inertia matrix has the entry of two of its coordinates; nothing if they are not of one
/// chain, whose entry is 0.
std::optional<int> matrix_entry(const mjModel& model, int first, int second) {
  const int outer = std::max(first, second);
  int entry = model.dof_Madr[outer];
  for (int dof = outer; dof >= 0; dof = model.dof_parentid[dof], ++entry) {
    if (dof == std::min(first, second)) return entry;
  }
  return std::nullopt;
}

struct CoupledEntry {
  int index;  ///< of the inertia matrix as MuJoCo stores it
  double inertia;
};

base::Result<std::vector<CoupledEntry>> find_entries(
    const mjModel& model, const std::string& name, const std::vector<Plant::Coupling>& couplings) {
  std::vector<CoupledEntry> entries;
  for (const Plant::Coupling& coupling : couplings) {
    const int first = mj_name2id(&model, mjOBJ_JOINT, coupling.first.c_str());
    const int second = mj_name2id(&model, mjOBJ_JOINT, coupling.second.c_str());
    const bool two_joints = first >= 0 && second >= 0 && first != second;
    const auto entry = two_joints
                           ? matrix_entry(model, model.jnt_dofadr[first], model.jnt_dofadr[second])
                           : std::nullopt;
    if (!entry || !std::isfinite(coupling.inertia)) {
      return base::Error{name + ": the coupling of '" + coupling.first + "' and '" +
                         coupling.second +
                         "' is expected to be a finite number between two joints of one chain"};
    }
    entries.push_back({*entry, coupling.inertia});
  }
  return entries;
}

/// MuJoCo softens friction, so that a joint creeps under load at a speed proportional to the load.
/// This makes it as hard as it can be: slip is gone within a step, and the creep is below a
/// nanoradian per second.
void harden_friction(mjModel& model, double step) {
  for (int dof = 0; dof < model.nv; ++dof) {
    mjtNum* const reference = model.dof_solref + dof * mjNREF;
    reference[0] = -1.0;         // direct: stiffness, which friction has none of, ...
    reference[1] = -1.0 / step;  // ... and damping
    mjtNum* const impedance = model.dof_solimp + dof * mjNIMP;
    impedance[0] = impedance[1] = mjMAXIMP;
    model.dof_invweight0[dof] *= 1e-3;  // the softness is in proportion to it
  }
  model.opt.tolerance = 1e-12;
}

}  // namespace

struct Plant::Impl {
  Model model;
  Data data;
  base::Duration inner_step{};
  base::Duration time{};
  base::Duration owed{};  // less than an inner step
  PlantStatus status = PlantStatus::kGood;
  std::vector<double> friction;  // without the brakes
  std::vector<CoupledEntry> coupled;

  std::size_t joints() const { return static_cast<std::size_t>(model->njnt); }
  int dof(std::size_t joint) const { return model->jnt_dofadr[joint]; }
  int coordinate(std::size_t joint) const { return model->jnt_qposadr[joint]; }
  void forward();
  void inner();
};

/// As mj_forward, with the couplings of the motors, which MuJoCo's own models do not know, in the
/// inertia matrix.
void Plant::Impl::forward() {
  if (coupled.empty()) {
    mj_forward(model.get(), data.get());
    return;
  }
  mj_fwdPosition(model.get(), data.get());
  for (const CoupledEntry& entry : coupled) data->qM[entry.index] += entry.inertia;
  mj_factorM(model.get(), data.get());
  mj_projectConstraint(model.get(), data.get());
  mj_fwdVelocity(model.get(), data.get());
  mj_fwdActuation(model.get(), data.get());
  mj_fwdAcceleration(model.get(), data.get());
  mj_fwdConstraint(model.get(), data.get());
}

/// The two halves of mj_step, which would begin anew on its own where a number is not finite.
void Plant::Impl::inner() {
  forward();
  if (!internal::is_sound(*model, *data)) {
    status = PlantStatus::kDiverged;
    return;
  }
  mj_Euler(model.get(), data.get());
  time += inner_step;
}

Plant::Plant(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Plant::Plant(Plant&&) noexcept = default;
Plant& Plant::operator=(Plant&&) noexcept = default;
Plant::~Plant() = default;

base::Result<Plant> Plant::load(const std::string& file, const Options& options) {
  std::error_code problem;  // A pipe would be waited for.
  if (std::filesystem::exists(file, problem) && !std::filesystem::is_regular_file(file, problem)) {
    return base::Error{file + ": is not a file, expected a URDF file"};
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) return base::Error{file + ": cannot be read, expected a URDF file"};
  return parse(text.str(), file, options);
}

base::Result<Plant> Plant::parse(const std::string& urdf, const std::string& name,
                                 const Options& options) {
  if (options.inner_step <= base::Duration{}) {
    return base::Error{name + ": inner_step is " + std::to_string(options.inner_step.count()) +
                       " ns, expected more than 0"};
  }
  auto compiled = internal::compile(urdf, name, "a URDF");
  if (!compiled) return base::Error{compiled.error()};
  auto impl = std::make_unique<Impl>();
  impl->model = std::move(compiled).value();
  impl->inner_step = options.inner_step;
  mjModel& model = *impl->model;
  if (const auto checked = check_joints(model, name); !checked) return base::Error{checked.error()};
  if (const auto set = set_armature(model, name, options.armature); !set) {
    return base::Error{set.error()};
  }
  auto coupled = find_entries(model, name, options.couplings);
  if (!coupled) return base::Error{coupled.error()};
  impl->coupled = std::move(coupled).value();
  std::copy(options.gravity.begin(), options.gravity.end(), model.opt.gravity);
  model.opt.timestep = base::to_seconds(options.inner_step);
  model.opt.disableflags |= mjDSBL_CONTACT;
  impl->data.reset(mj_makeData(&model));
  mj_setConst(&model, impl->data.get());
  harden_friction(model, model.opt.timestep);
  mj_resetData(&model, impl->data.get());
  impl->friction.assign(model.dof_frictionloss, model.dof_frictionloss + model.nv);
  return Plant(std::move(impl));
}

std::size_t Plant::joints() const { return impl_->joints(); }

std::string_view Plant::name(std::size_t joint) const {
  return joint_name(*impl_->model, static_cast<int>(joint));
}

std::optional<std::size_t> Plant::find(std::string_view name) const {
  for (std::size_t joint = 0; joint < joints(); ++joint) {
    if (this->name(joint) == name) return joint;
  }
  return std::nullopt;
}

double Plant::position(std::size_t joint) const {
  return impl_->data->qpos[impl_->coordinate(joint)];
}

std::optional<std::pair<double, double>> Plant::stops(std::size_t joint) const {
  const mjModel& model = *impl_->model;
  if (model.jnt_limited[joint] == 0) return std::nullopt;
  return std::pair{model.jnt_range[2 * joint], model.jnt_range[2 * joint + 1]};
}

double Plant::velocity(std::size_t joint) const { return impl_->data->qvel[impl_->dof(joint)]; }

void Plant::set_state(std::size_t joint, double position, double velocity) {
  impl_->data->qpos[impl_->coordinate(joint)] = position;
  impl_->data->qvel[impl_->dof(joint)] = velocity;
}

void Plant::set_effort(std::size_t joint, double effort) {
  impl_->data->qfrc_applied[impl_->dof(joint)] = effort;
}

void Plant::set_brake(std::size_t joint, double holding_effort) {
  const auto dof = static_cast<std::size_t>(impl_->dof(joint));
  impl_->model->dof_frictionloss[dof] = impl_->friction[dof] + holding_effort;
}

PlantStatus Plant::step(base::Duration dt) {
  impl_->owed += dt;
  while (impl_->owed >= impl_->inner_step && impl_->status == PlantStatus::kGood) {
    impl_->inner();
    impl_->owed -= impl_->inner_step;
  }
  return impl_->status;
}

PlantStatus Plant::status() const { return impl_->status; }
base::Duration Plant::time() const { return impl_->time; }
base::Duration Plant::inner_step() const { return impl_->inner_step; }

}  // namespace armature::sim
