// SPDX-License-Identifier: Apache-2.0
#include "tests/configurations/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/document/yaml.hpp"
#include "armature/remote/network.hpp"
#include "tests/configurations/motion_watch.hpp"

namespace armature::configurations {
namespace {

using namespace std::chrono_literals;
using component::State;

constexpr base::Duration kStep = 2ms;
/// In which a speed that is commanded has to be said again.
constexpr base::Duration kRenewal = 100ms;
/// [rad/s] by which a joint may become faster while its motor gives way to its brake.
constexpr double kGive = 0.3;

std::string first_line(const base::Diagnostics& diagnostics) {
  for (const base::Diagnostic& one : diagnostics.all()) {
    if (one.severity == base::Severity::kError) return one.message;
  }
  return "";
}

/// What nobody armed stands: as it is promised.
Bounds unarmed() { return {.speed = 0.1, .moved = 0.01}; }
/// While brakes open and the controller takes over. A joint that moves by more than its
/// ArmingMotion of 0.01 rad is braked again, and until then it moves on; what is shipped uses a
/// fifth of this.
Bounds being_armed() { return {.speed = 0.3, .moved = 0.02}; }
/// Armed, and to stand: what is shipped uses a quarter of it. The joints' own watch brakes at 0.1
/// rad and 0.5 rad/s: gains that come so far are to be refused by the check already.
Bounds held() { return {.speed = 0.1, .moved = 0.02}; }
/// With nothing but the weight compensated, it drifts where a hand-over has left it a velocity.
Bounds weightless() { return {.speed = 0.1, .moved = 0.1}; }
/// Where a motion has ended: a weak controller is on its way still, but nothing shakes.
Bounds at_the_end() { return {.speed = 0.1, .moved = 0.1}; }

/// The run of one deployment, phase by phase; the first that goes wrong ends it.
class Trial {
 public:
  Trial(const RobotUnderTest& robot, deploy::Deployment deployment, const std::string& folder)
      : robot_(robot),
        document_(std::move(deployment.document)),
        tell_(std::getenv("CONFIGURATIONS_TOLD") != nullptr) {
    exec::ApplicationOptions options = std::move(deployment.options);
    options.simulated = true;
    options.output_folder = folder;
    options.attend = [this] { observe(); };
    application_.emplace(std::move(deployment.blueprint), std::move(options));
  }

  Verdict run() {
    const base::Diagnostics started = application_->start();
    if (!started.ok()) return {Outcome::kNotStarted, first_line(started)};
    set_up_plants();
    for (void (Trial::*phase)() :
         {&Trial::stand, &Trial::arm, &Trial::move_there, &Trial::ask_for_too_much,
          &Trial::go_over_to_each_mode, &Trial::move_back_and_stop_in_emergency}) {
      (this->*phase)();
      if (!ok()) break;
    }
    const base::Diagnostics stopped = application_->stop();
    if (ok() && application_->hangs()) fail("it hangs: " + stopped.to_text());
    if (!ok()) return {Outcome::kUnsafe, phase_ + ": " + problem_};
    if (outcome() == Outcome::kQuiet && !has_moved_) return {Outcome::kQuiet, "it did not move"};
    return {outcome(), first_fault_};
  }

 private:
  bool ok() const { return problem_.empty(); }
  void fail(const std::string& problem) {
    if (ok()) problem_ = problem;
  }

  Outcome outcome() const {
    if (!first_fault_.empty()) return Outcome::kFaulted;
    return was_armed_ ? Outcome::kQuiet : Outcome::kNotArmed;
  }

  // ---- Looking at it

  void set_up_plants() {
    plants_ = plants_of(document_, *application_);
    for (const auto& plant : plants_) watches_.emplace_back(plant->positions());
  }

  /// All plants, as often as anything happens.
  void observe() {
    const base::Time now = application_->now();
    for (std::size_t i = 0; i < watches_.size(); ++i) {
      plants_[i]->advance_to(now);
      watches_[i].look_at(now, plants_[i]->positions());
    }
  }

  void run_for(base::Duration duration) {
    for (base::Duration done{}; done < duration; done += kStep) {
      if (done % kRenewal == base::Duration::zero()) renew_speed();
      application_->run_for(kStep);
      observe();
      note_faults();
      watch_what_is_let_go();
    }
    judge();
  }

  void judge() {
    for (MotionWatch& watch : watches_) {
      if (auto problem = watch.problem()) fail(*problem);
    }
  }
  /// Where what is shipped is tried out: which bounds are wide.
  void tell_what_it_did() {
    if (!tell_) return;
    for (std::size_t i = 0; i < watches_.size(); ++i) {
      std::printf("  %-36s %3.0f %% of its bounds\n", phase_.c_str(), 100.0 * watches_[i].worst());
    }
  }

  void note_faults() {
    if (stopped_ || !first_fault_.empty() ||
        application_->faults() + application_->reactions() == 0)
      return;
    for (const exec::ComponentEntry& entry : application_->blueprint().components) {
      const State state = entry.component->state();
      if (state == State::kRunning || entry.component->reason().empty()) continue;
      first_fault_ = entry.component->name() + ": " + std::string(entry.component->reason());
      break;
    }
    if (first_fault_.empty()) first_fault_ = "a reaction";
  }

  // ---- What it may

  void begin(const char* phase, const Bounds& bounds) {
    tell_what_it_did();
    phase_ = phase;
    if (let_go_at_) return;  // It has bounds of its own.
    for (MotionWatch& watch : watches_) watch.allow_from_now(bounds);
  }
  Bounds in_motion() const {
    return {.speed = robot_.most_speed, .moved = {}, .lower = robot_.lower, .upper = robot_.upper};
  }

  /// No faster than that motion has to be: three times its mean, where it is at most twice.
  Bounds in_motion(const Vector& target, double time) const {
    const Vector from = positions();
    double way = 0.0;
    for (std::size_t i = 0; i < target.size() && i < from.size(); ++i) {
      way = std::max(way, std::abs(target[i] - from[i]));
    }
    Bounds bounds = in_motion();
    bounds.speed = std::min(bounds.speed, 0.1 + 3.0 * way / time);
    return bounds;
  }

  Bounds to_stand() const {
    if (drives_itself()) return in_motion();
    const bool is_weightless = std::ranges::any_of(
        document_.modes, [](const document::Mode& mode) { return mode.name == "weightless"; });
    return is_weightless ? weightless() : held();
  }

  /// From now on brakes hold it, or it sinks: no faster than it is, and soon as slow as that is.
  void let_go() {
    for (MotionWatch& watch : watches_) {
      Bounds bounds = in_motion();
      bounds.speed = std::max(watch.fastest() + kGive, robot_.sinking);
      watch.allow_from_now(bounds);
    }
    let_go_at_ = application_->now();
  }
  void watch_what_is_let_go() {
    if (!let_go_at_) {
      const bool driven = is_driven();
      if (was_armed_ && std::exchange(was_driven_, driven) && !driven) let_go();
    } else if (!sinks_ && application_->now() - *let_go_at_ >= base::from_seconds(robot_.braking)) {
      sinks_ = true;
      Bounds bounds = in_motion();
      bounds.speed = robot_.sinking;
      for (MotionWatch& watch : watches_) watch.allow_from_now(bounds);
    }
  }
  bool is_driven() const {
    return std::ranges::any_of(plants_, [](const auto& plant) { return plant->driven(); });
  }

  // ---- Phases

  void stand() {
    begin("unarmed", unarmed());
    run_for(1s);
    if (!ok()) return;
    let_nobody_press_keys();
    act_as_a_script();
    phase_ = "unarmed, after what a script did";
    run_for(2s);
  }
  /// Whatever a script may do without a grant, it does.
  void act_as_a_script() {
    for (const document::Component& each : document_.components) {
      for (const char* act :
           {"shiftActivate", "releaseEstop", "actuatorOn", "brakeRelease", "motorOn"}) {
        static_cast<void>(application_->call(each.name, act, {}, exec::Caller::kScript));
      }
    }
  }
  void let_nobody_press_keys() {
    for (const document::Component& each : document_.components) {
      if (each.model != "WamHardware") continue;
      static_cast<void>(
          application_->set_property(each.name, "emulated_operator", types::Value::of(false)));
    }
  }

  void arm() {
    begin("being armed", being_armed());
    const auto asked = application_->call(name_of_model("Arming"), "arm", {});
    for (int i = 0; i < 500 && ok() && asked && !armed(); ++i) run_for(kStep);
    if (!ok()) return;
    was_armed_ = armed();
    hold("armed");
  }
  void hold(const char* phase) {
    begin(phase, to_stand());
    run_for(1s);
  }
  bool armed() {
    const auto value = application_->value_of(name_of_model("Arming"), "armed");
    return value && *static_cast<const bool*>(value.value().data());
  }
  std::string name_of_model(std::string_view model) const {
    for (const document::Component& each : document_.components) {
      if (each.model == model) return each.name;
    }
    return std::string(model);
  }

  /// What has wheels is told speeds, as long as it is to drive.
  bool has_wheels() const {
    return name_of_model("ChassisDrive") != "ChassisDrive" || name_of_model("Chassis") != "Chassis";
  }
  bool drives_itself() const { return name_of_model("Latch") != "Latch"; }
  void renew_speed() {
    if (application_->now() >= drives_until_) return;
    static_cast<void>(application_->call("Chassis.Drive", "setVelocity",
                                         {types::Value::of(speed_), types::Value::of(speed_)}));
  }
  void drive_to(const char* phase, double way, double time) {
    speed_ = static_cast<float>(way / time);
    drives_until_ = application_->now() + base::from_seconds(time);
    begin(phase, in_motion());
  }

  /// What is refused leaves it standing.
  void move_to(const char* phase, const Vector& positions, double time) {
    if (has_wheels()) return drive_to(phase, positions[0] - this->positions()[0], time);
    const auto begun = application_->begin(name_of_model("nAxesGeneratorPos"), "moveTo",
                                           {types::Value::of(positions), types::Value::of(time)});
    begin(phase, begun ? in_motion(positions, time) : at_the_end());
  }
  Vector positions() const { return plants_.empty() ? robot_.step : plants_.front()->positions(); }

  void move_there() {
    start_ = positions();
    Vector target = start_;
    for (std::size_t i = 0; i < target.size() && i < robot_.step.size(); ++i) {
      target[i] += plants_.empty() ? 0.0 : robot_.step[i];
    }
    move_to("moving", target, 2.0);
    run_for(4s);
    const Vector end = positions();
    for (std::size_t i = 0; i < end.size(); ++i) {
      has_moved_ = has_moved_ || std::abs(end[i] - start_[i]) > 0.1;
    }
    if (!ok()) return;
    begin("at the end of a motion", drives_itself() ? in_motion() : at_the_end());
    run_for(1s);
  }
  void ask_for_too_much() {
    move_to("asked for too much", Vector(robot_.step.size(), 10.0), 0.2);
    run_for(1s);
  }
  void go_over_to_each_mode() {
    for (const document::Mode& mode : document_.modes) {
      if (!ok()) return;
      begin("going over to another mode", to_stand());
      static_cast<void>(application_->switch_mode(mode.name));
      run_for(1s);
    }
  }

  /// The button, or the operator's disarming where there is none, in the middle of a motion.
  void move_back_and_stop_in_emergency() {
    Vector target = positions();
    for (std::size_t i = 0; i < target.size(); ++i) target[i] += 0.9 * (start_[i] - target[i]);
    move_to("moving back", target, 2.0);
    run_for(1s);
    if (!ok()) return;
    begin("E-stop", in_motion());
    stopped_ = true;
    bool pressed = false;
    for (const auto& plant : plants_) pressed = plant->press_estop() || pressed;
    if (!pressed) static_cast<void>(application_->call(name_of_model("Arming"), "disarm", {}));
    if (!let_go_at_) let_go();
    run_for(1200ms);
    if (is_driven()) fail("a motor is driven still after 1.2 s");
    run_for(500ms);
    tell_what_it_did();
  }

  const RobotUnderTest& robot_;
  document::Document document_;
  const bool tell_;
  std::optional<exec::Application> application_;
  std::vector<std::unique_ptr<Plant>> plants_;
  std::vector<MotionWatch> watches_;
  std::string phase_ = "start";
  std::string problem_;
  std::string first_fault_;
  float speed_ = 0.0F;         ///< of what has wheels [m/s]
  base::Time drives_until_{};  ///< so long
  Vector start_;               ///< of its motions
  bool was_armed_ = false;
  bool was_driven_ = false;
  std::optional<base::Time> let_go_at_;  ///< its motors are off
  bool sinks_ = false;                   ///< and it has come to rest, or sinks
  bool has_moved_ = false;
  bool stopped_ = false;  ///< in an emergency: what is out of service since then is so on purpose
};

}  // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kRefused:
      return "refused";
    case Outcome::kNotStarted:
      return "not started";
    case Outcome::kNotArmed:
      return "not armed";
    case Outcome::kFaulted:
      return "faulted";
    case Outcome::kQuiet:
      return "quiet";
    case Outcome::kUnsafe:
      return "UNSAFE";
  }
  return "UNSAFE";
}

Verdict try_out(const RobotUnderTest& robot, const document::Document& document,
                const std::string& folder) {
  const std::unique_ptr<remote::Network> network = remote::make_network({});
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.make_placeholder = [&network](const document::Component& written,
                                        std::unique_ptr<component::Component> prototype) {
    return network->make_placeholder(written, std::move(prototype));
  };
  options.make_inlets = [&network](const std::vector<component::InputPortBase*>& inputs) {
    using Made = base::Result<std::unique_ptr<component::Component>>;
    return Made(network->make_inlets(inputs));
  };
  const auto checked = [&](const document::Document& one) {
    deploy::Deployment deployment =
        deploy::parse_deployment(document::write_yaml(one), one.file, options);
    if (!one.network.listen.empty()) network->check(one, deployment.diagnostics);
    return deployment;
  };
  deploy::Deployment deployment = checked(document);
  const auto of_simulated = simulated(document);
  if (deployment.ok() && of_simulated) deployment = checked(*of_simulated);
  if (!deployment.ok()) return {Outcome::kRefused, first_line(deployment.diagnostics)};
  return Trial(robot, std::move(deployment), folder).run();
}

}  // namespace armature::configurations
