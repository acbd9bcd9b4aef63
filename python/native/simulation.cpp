// SPDX-License-Identifier: Apache-2.0
#include "python/native/simulation.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/base/seconds.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/component/operations/argument_unit.hpp"
#include "armature/inspect/acts.hpp"
#include "armature/platform/clock.hpp"
#include "armature/runner/run_options.hpp"
#include "armature/types/elements.hpp"
#include "python/native/hook.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using inspect::Member;
using inspect::Refusal;

/// What Lua may do, so may Python: acts of the operator only if they are granted.
constexpr exec::Caller kCaller = exec::Caller::kScript;

template <typename T>
T answer_of(base::Result<T> result) {
  if (!result) throw Refusal(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

exec::Grant grant_of(const std::string& act) {
  const std::size_t dot = act.rfind('.');
  if (dot == std::string::npos) {
    throw py::value_error("a grant is written Component.operation, found '" + act + "'");
  }
  return {kCaller, act.substr(0, dot), act.substr(dot + 1)};
}

const char* name_of(exec::RunEnd end) {
  switch (end) {
    case exec::RunEnd::kTimeUp:
      return "time_up";
    case exec::RunEnd::kConditionMet:
      return "condition_met";
    case exec::RunEnd::kStopRequested:
      return "stop_requested";
    case exec::RunEnd::kFaulted:
      return "faulted";
    case exec::RunEnd::kStoppedByReaction:
      break;
  }
  return "stopped_by_reaction";
}

/// Asks now and then whether the user wants to interrupt, which costs the interpreter's lock.
class Interruption {
 public:
  bool is_due() {
    constexpr int kInstants = 16;
    constexpr base::Duration kInterval = std::chrono::milliseconds(50);
    if (++instants_ % kInstants != 0) return false;
    return platform::monotonic_now() - last_ > kInterval;
  }
  /// Throws KeyboardInterrupt, if that is so.
  void look() {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    last_ = platform::monotonic_now();
  }

 private:
  int instants_ = 0;
  base::Time last_ = platform::monotonic_now();
};

/// A number with a unit, `"12 V"`, in that of what it is for.
py::object in_unit(std::string_view unit, const types::Type& type, py::handle value,
                   const std::string& name) {
  const bool is_text = PyUnicode_Check(value.ptr()) && types::is_number(type);
  if (!is_text) return py::reinterpret_borrow<py::object>(value);
  const auto quantity = base::parse_quantity(text_from_python(value));
  if (!quantity) throw py::value_error(name + ": " + quantity.error());
  if (quantity.value().unit.empty()) return py::float_(quantity.value().value);
  const auto number = base::convert(quantity.value().value, quantity.value().unit, unit);
  if (!number) throw py::value_error(name + ": " + number.error());
  return py::float_(number.value());
}

types::Value value_for(const Member& member, py::handle value) {
  const std::string name = member.name();
  const bool inverts =
      member.property != nullptr && member.property->is_sign() && PyBool_Check(value.ptr());
  if (inverts) return from_python(value, types::type_of<bool>(), name);
  return from_python(in_unit(member.unit(), member.type(), value, name), member.type(), name);
}

bool includes(const std::vector<exec::Casualty>& all, const exec::Casualty& one) {
  return std::ranges::any_of(all, [&](const auto& other) {
    return other.component == one.component && other.reason == one.reason;
  });
}

}  // namespace

inspect::LifeCycleChange change_named(const std::string& name) {
  using inspect::LifeCycleChange;
  if (name == "start") return LifeCycleChange::kStart;
  if (name == "stop") return LifeCycleChange::kStop;
  if (name == "reset") return LifeCycleChange::kReset;
  if (name == "recover") return LifeCycleChange::kRecover;
  return LifeCycleChange::kCleanup;
}

/// The caller's turn to drive the application.
class Simulation::Turn {
 public:
  explicit Turn(Simulation& simulation) : simulation_(simulation) {
    expect_no_hook();
    const std::thread::id me = std::this_thread::get_id();
    std::thread::id driver{};
    const bool mine = simulation.driver_.compare_exchange_strong(driver, me) || driver == me;
    if (!mine) {
      throw Refusal(
          "the application is driven by another thread now: wait for it, or use an "
          "application of your own");
    }
    ++simulation.depth_;
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    if (--simulation_.depth_ == 0) simulation_.driver_ = std::thread::id{};
  }
  void expect_outermost() const {
    if (simulation_.depth_ > 1) {
      throw Refusal("time passes already: a condition looks, and does not let time pass");
    }
  }

 private:
  Simulation& simulation_;
};

Simulation::Simulation(std::shared_ptr<Deployed> deployed, std::string record,
                       const std::vector<std::string>& grants)
    : deployed_(std::move(deployed)) {
  deployed_->expect_alone();
  if (!record.empty()) {
    std::error_code failure;
    std::filesystem::create_directories(record, failure);
    if (failure) throw Refusal("cannot make the folder '" + record + "': " + failure.message());
    folder_ = answer_of(platform::FolderLock::take(record));
  }
  deploy::Deployment deployment = deployed_->take();
  exec::ApplicationOptions options = std::move(deployment.options);
  runner::RunOptions run;
  run.simulated = true;
  run.output_folder = std::move(record);
  runner::apply(run, options);
  // Nobody expects files of a run without a folder.
  if (run.output_folder.empty()) options.black_box.write = nullptr;
  for (const std::string& act : grants) options.grants.push_back(grant_of(act));
  options.attend = [this] {
    now_ns_.store(base::to_ns(application_->now()), std::memory_order_relaxed);
  };
  application_.emplace(std::move(deployment.blueprint), std::move(options));
  view_.emplace(*application_, kCaller);
}

Simulation::~Simulation() = default;

base::Diagnostics Simulation::start() {
  const Turn turn(*this);
  const py::gil_scoped_release others_run;
  return application_->start();
}

base::Diagnostics Simulation::stop(bool in_order) {
  const Turn turn(*this);
  turn.expect_outermost();
  if (!running()) return {};
  const py::gil_scoped_release others_run;
  const auto leave = in_order ? exec::Leave::kInOrder : exec::Leave::kAfterMistake;
  const std::vector<exec::Casualty> before = faults_now();
  base::Diagnostics problems = application_->run_before_stop(last_end_, nullptr, leave);
  problems.append(application_->stop());
  folder_ = platform::FolderLock();  // its recordings are complete
  report_new_faults(before, problems);
  return problems;
}

/// A stop in which a component fails is not in good order.
void Simulation::report_new_faults(const std::vector<exec::Casualty>& before,
                                   base::Diagnostics& problems) {
  for (const exec::Casualty& one : faults_when_stopped()) {
    if (includes(before, one)) continue;
    problems.error({},
                   base::quoted(one.component) + " faulted while it was stopped: " + one.reason);
  }
}

void Simulation::expect_running() const {
  if (!running()) {
    throw Refusal("the application has stopped: make a new one, by `deployment.application()`");
  }
}

const char* Simulation::last_end() const { return name_of(last_end_); }

std::vector<exec::Casualty> Simulation::faults() {
  const Turn turn(*this);
  return running() ? faults_now() : faults_when_stopped();
}

std::vector<exec::Casualty> Simulation::faults_now() {
  std::vector<exec::Casualty> faults;
  for (const auto& one : view_->components()) {
    if (one.state != component::State::kException) continue;
    faults.push_back({one.name, component::State::kException, one.reason});
  }
  return faults;
}

std::vector<exec::Casualty> Simulation::faults_when_stopped() const {
  std::vector<exec::Casualty> faults = application_->casualties();
  std::erase_if(faults, [](const auto& one) { return one.state != component::State::kException; });
  return faults;
}

exec::RunEnd Simulation::run_until(base::Time end, const py::object& condition) {
  Interruption interruption;
  bool met = false;
  const auto asked = [&] {
    if (condition.is_none()) return false;
    const py::gil_scoped_acquire lock;
    return static_cast<bool>(py::bool_(condition()));
  };
  const py::gil_scoped_release others_run;
  while (true) {
    const exec::RunEnd ended =
        application_->run_until(end, [&] { return (met = asked()) || interruption.is_due(); });
    if (met || ended != exec::RunEnd::kConditionMet) return ended;
    interruption.look();
  }
}

const char* Simulation::run_for(base::Duration duration, const py::object& condition) {
  const Turn turn(*this);
  turn.expect_outermost();
  expect_running();
  last_end_ = run_until(base::later(application_->now(), duration), condition);
  return name_of(last_end_);
}

void Simulation::step(base::Duration at_most) {
  const Turn turn(*this);
  turn.expect_outermost();
  expect_running();
  const py::gil_scoped_release others_run;
  bool moved_on = false;
  last_end_ = application_->run_until(base::later(application_->now(), at_most),
                                      [&] { return std::exchange(moved_on, true); });
}

std::vector<std::string> Simulation::component_names() { return view_->component_names(); }

inspect::ComponentDescription Simulation::describe(const std::string& component, bool with_values) {
  const Turn turn(*this);
  return view_->describe(component,
                         with_values ? inspect::Values::kIncluded : inspect::Values::kLeftOut);
}

std::vector<inspect::ComponentStatus> Simulation::components() {
  const Turn turn(*this);
  return view_->components();
}

std::vector<exec::LogLine> Simulation::log(std::uint64_t after) {
  const Turn turn(*this);
  application_->drain_logs();
  return application_->log_history().lines_after(after, exec::LogHistory::kCapacity);
}

std::uint64_t Simulation::raised(const std::string& component, const std::string& event) {
  const Turn turn(*this);
  for (const auto& one : view_->describe(component, inspect::Values::kIncluded).events) {
    if (one.name == event) return one.raised;
  }
  return 0;
}

void Simulation::change(const std::string& component, const std::string& change) {
  const Turn turn(*this);
  expect_running();
  const py::gil_scoped_release others_run;
  view_->change(component, change_named(change));
}

Member Simulation::find(const std::string& component, const std::string& member) {
  return answer_of(inspect::find_member(*application_, component + "." + member));
}

Member Simulation::find_value(const std::string& component, const std::string& name) {
  Member member = find(component, name);
  if (member.has_value()) return member;
  throw Refusal(base::quoted(member.name()) + " has no value: it is " +
                (member.operation != nullptr ? "an operation, which is called" : "an event"));
}

Reading Simulation::read(const std::string& component, const std::string& name) {
  const Turn turn(*this);
  const Member member = find_value(component, name);
  const auto readings = [&] {
    const py::gil_scoped_release others_run;
    return inspect::read_members(*application_, {member});
  }();
  if (!readings) throw inspect::NoAnswer("the thread of '" + component + "' does not answer");
  const inspect::Reading& reading = readings->front();
  if (!reading.written) return {py::none()};
  return {to_python(reading.whole.type(), reading.whole.data()), base::to_seconds(reading.age)};
}

void Simulation::write(const std::string& component, const std::string& name, py::handle value) {
  const Turn turn(*this);
  const Member member = find_value(component, name);
  answer_of(inspect::check_settable(*application_, member, kCaller));
  const types::Value wanted = value_for(member, value);
  const py::gil_scoped_release others_run;
  answer_of(inspect::set(*application_, member, wanted, kCaller));
}

std::vector<types::Value> Simulation::arguments_of(const Member& operation,
                                                   const py::tuple& given) {
  answer_of(inspect::check_count(operation, given.size()));
  const auto& wanted = operation.operation->signature().arguments;
  std::vector<types::Value> values;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::string name = inspect::argument_name(operation, i);
    const types::Type& type = *wanted[i].type;
    values.push_back(from_python(
        in_unit(component::argument_unit(wanted[i].name), type, given[i], name), type, name));
  }
  return values;
}

py::object Simulation::call(const std::string& component, const std::string& name,
                            const py::tuple& arguments) {
  const Turn turn(*this);
  const Member operation = find(component, name);
  std::vector<types::Value> values = arguments_of(operation, arguments);
  const std::optional<types::Value> result = [&] {
    const py::gil_scoped_release others_run;
    return answer_of(inspect::call(*application_, operation, std::move(values), kCaller));
  }();
  return result ? to_python(result->type(), result->data()) : py::none();
}

component::CommandHandle Simulation::begin(const std::string& component, const std::string& name,
                                           const py::tuple& arguments) {
  const Turn turn(*this);
  const Member command = find(component, name);
  std::vector<types::Value> values = arguments_of(command, arguments);
  const py::gil_scoped_release others_run;
  return answer_of(inspect::begin(*application_, command, std::move(values), kCaller));
}

}  // namespace armature::python
