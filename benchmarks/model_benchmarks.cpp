// SPDX-License-Identifier: Apache-2.0
// What the inverse dynamics of a robot take: by themselves, as a component, and in the cycle of the
// Janus head (paper 1, section 5.2: feed-forward adds 10 us).
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/controllers/model/model.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "benchmarks/set_property.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kRounds = 301;
constexpr std::chrono::milliseconds kBatch{3};

struct Robot {
  std::string file;
  int joints;
};

const Robot kRobots[] = {{ARMATURE_SOURCE_DIR "/robots/janus/janus.urdf", 2},
                         {ARMATURE_SOURCE_DIR "/robots/wam/wam7.urdf", 7}};

template <typename T>
T must(base::Result<T> result) {
  if (!result) throw std::runtime_error(result.error());
  return std::move(result).value();
}

void check(const base::Diagnostics& diagnostics) {
  if (!diagnostics.ok()) throw std::runtime_error(diagnostics.to_text());
}

std::vector<double> some_motion(int joints) {
  std::vector<double> motion(static_cast<std::size_t>(3 * joints));
  for (std::size_t i = 0; i < motion.size(); ++i) motion[i] = 0.1 * static_cast<double>(i + 1);
  return motion;
}

/// The recursive Newton-Euler algorithm of KDL, with nothing around it.
class Bare {
 public:
  explicit Bare(const Robot& robot)
      : motion_(some_motion(robot.joints)), torques_(static_cast<std::size_t>(robot.joints)) {
    base::Diagnostics diagnostics;
    dynamics_ = control::InverseDynamics::load(robot.file, {}, diagnostics);
    check(diagnostics);
  }
  void step() {
    motion_[0] += 1e-6;
    dynamics_->step(motion_, torques_);
    benchmark::DoNotOptimize(torques_.data());
  }

 private:
  std::optional<control::InverseDynamics> dynamics_;
  std::vector<double> motion_;
  std::vector<double> torques_;
};

/// Asks for the torques of a motion, each time it runs.
class Asker final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    motion_ = some_motion(joints_.get());
    return component::accepted();
  }
  void on_update() override {
    motion_[0] += 1e-6;
    motion_out_.write(motion_);
  }

  component::Property<int> joints_{this, "joints", 2, "how many", "", component::range(1, 100)};
  component::OutputPort<std::vector<double>> motion_out_{this, "Motion", "[q, qd, qdd]", "",
                                                         component::size_of(joints_, 3)};
  std::vector<double> motion_;
};

exec::Blueprint asked_model(const Robot& robot) {
  exec::Blueprint blueprint;
  blueprint.name = "model";
  set(blueprint.add<Asker>("Asker", exec::Activity::periodic(1ms)), "joints", robot.joints);
  auto& model = blueprint.add<controllers::Model>("Model");
  set(model, "joints", robot.joints);
  set(model, "robot_description", robot.file);
  blueprint.connect("Asker.Motion", "Model.In");
  return blueprint;
}

void run_model(benchmark::State& state, const Robot& robot) {
  exec::Application application(asked_model(robot), simulated());
  check(application.start());
  Bare bare(robot);
  publish(
      state,
      measure_in_turn(
          state, [&](std::int64_t count) { application.run_for(std::chrono::milliseconds(count)); },
          [&](std::int64_t count) {
            for (std::int64_t i = 0; i < count; ++i) bare.step();
          },
          kBatch));
}

/// A step now and then, as in a cycle of 100 Hz, beside one step after another.
void run_after_a_pause(benchmark::State& state, const Robot& robot) {
  Bare bare(robot);
  const auto duration_of = [&](int steps) {
    const base::Time begin = platform::monotonic_now();
    for (int i = 0; i < steps; ++i) bare.step();
    return static_cast<double>((platform::monotonic_now() - begin).count()) / steps;
  };
  std::vector<double> rare;
  std::vector<double> dense;
  for (auto round : state) {
    (void)round;
    dense.push_back(duration_of(100));
    std::this_thread::sleep_for(10ms);
    rare.push_back(duration_of(1));
    state.SetIterationTime(rare.back() * 1e-9);
  }
  publish(state, {median(rare), "ns", median(dense), std::nullopt, std::nullopt});
}

/// The Janus head, armed, holding its position.
class Head {
 public:
  explicit Head(const std::string& deployment) {
    deploy::DeploymentOptions options;
    options.library_folders = {ARMATURE_ROBOT_LIBRARIES};
    auto loaded = deploy::load_deployment(
        ARMATURE_SOURCE_DIR "/robots/janus/deployments/" + deployment, options);
    check(loaded.diagnostics);
    loaded.options.simulated = true;
    application_ = std::make_unique<exec::Application>(std::move(loaded.blueprint), loaded.options);
    check(application_->start());
    application_->run_for(100ms);
    must(application_->call("Arming", "arm", {}));
    application_->run_for(2s);
  }
  void run(std::int64_t cycles) { application_->run_for(cycles * 10ms); }

 private:
  std::unique_ptr<exec::Application> application_;
};

void run_feed_forward(benchmark::State& state) {
  Head with("pid_feed_forward.yaml");
  Head without("pid.yaml");
  publish(state, measure_in_turn(
                     state, [&](std::int64_t cycles) { with.run(cycles); },
                     [&](std::int64_t cycles) { without.run(cycles); }, kBatch));
}

}  // namespace

void add_models(const Suite& suite) {
  for (const Robot& robot : kRobots) {
    const std::string joints = std::to_string(robot.joints);
    suite.add("model/" + joints, kRounds,
              [&robot](benchmark::State& state) { run_model(state, robot); });
    suite.add("model/" + joints + "/after_10_ms", kRounds,
              [&robot](benchmark::State& state) { run_after_a_pause(state, robot); });
  }
  suite.add("janus_feed_forward", kRounds, run_feed_forward);
}

}  // namespace armature::benchmarks
