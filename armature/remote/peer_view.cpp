// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/peer_view.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/remote/internal/harmless.hpp"
#include "armature/remote/internal/inspection.hpp"
#include "inspection_client.hpp"

namespace armature::remote {
namespace {

using namespace std::chrono_literals;
using inspect::ComponentDescription;
using internal::from_wire;
using internal::harmless;

/// An application that is asked while it stops, or waits for a component that hangs, takes seconds.
constexpr ride::CallOptions kPatient{.deadline = 15s, .priority = {}};
constexpr base::Duration kDirectoryLimit = 5s;

/// Without the placeholder's name and operation: who asks knows whom they have asked.
std::string problem_of(ride::Code code, const std::string& error) {
  const std::string begin = std::string(ride::name_of(code)) + ": ";
  const std::size_t at = error.find(begin);
  std::string text = at == std::string::npos ? error : error.substr(at + begin.size());
  if (code == ride::Code::kNotAllowed) text = "not allowed: " + text;
  return harmless(text);
}

/// What the peer answered, on the wire.
template <typename T>
T taken(ride::Answer<T> answer) {
  if (answer.ok()) {
    internal::make_harmless(answer.value());
    return std::move(answer.value());
  }
  const std::string problem = problem_of(answer.code(), answer.error());
  if (answer.code() == ride::Code::kFailed) throw inspect::Refusal(problem);
  throw inspect::NoAnswer(problem);
}

template <typename T>
auto told_by(ride::Answer<T> answer) {
  return from_wire(taken(std::move(answer)));
}

template <typename T>
auto all_told_by(ride::Answer<std::vector<T>> answer) {
  return internal::each(taken(std::move(answer)), [](const T& one) { return from_wire(one); });
}

ComponentDescription without_values(ComponentDescription description) {
  const auto clear = [](auto& members) {
    for (auto& one : members) one.value.clear();
  };
  clear(description.properties);
  clear(description.inputs);
  clear(description.outputs);
  description.answered = false;
  return description;
}

void keep_only(std::vector<inspect::ComponentStatus>& all, const inspect::View::Which& which) {
  std::erase_if(all, [&](const inspect::ComponentStatus& one) { return !which(one.name); });
}

}  // namespace

/// The inspector of a peer, and what is known of what it told.
class PeerView::Client {
 public:
  Client(ride::Peer& its_peer, const std::string& name)
      : peer(its_peer),
        inspector(its_peer, name),
        name_(name),
        watch_(its_peer.on_change([this](const ride::PeerChange& change) {
          const std::lock_guard lock(mutex_);
          changes_.push_back({change.connected, harmless(change.text)});
        })) {}

  std::vector<ride::PeerChange> take_changes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(changes_, {});
  }

  void forget() {
    hosted_.clear();
    has_application_.reset();
    names.clear();
    known.clear();
  }

  const std::vector<ride::PeerComponent>& hosted() {
    if (!hosted_.empty()) return hosted_;
    auto listed = peer.components(kDirectoryLimit);
    if (!listed) throw inspect::NoAnswer(harmless(listed.error()));
    hosted_ = std::move(listed).value();
    for (ride::PeerComponent& one : hosted_) {
      one.name = harmless(one.name);
      one.interface = harmless(one.interface);
    }
    return hosted_;
  }

  bool has_application() {
    if (has_application_) return *has_application_;
    const auto& all = hosted();
    const bool listed = std::any_of(all.begin(), all.end(), [&](const ride::PeerComponent& one) {
      return one.name == name_ && one.interface == inspector.interface().name;
    });
    // The directory may know it before the placeholder has asked again.
    has_application_ =
        listed && inspector.application(kPatient).code() != ride::Code::kNoSuchComponent;
    return *has_application_;
  }

  ride::Peer& peer;
  InspectorPlaceholder inspector;
  std::vector<std::string> names;
  std::map<std::string, ComponentDescription, std::less<>> known;

 private:
  const std::string name_;
  std::vector<ride::PeerComponent> hosted_;
  std::optional<bool> has_application_;
  std::mutex mutex_;
  std::vector<ride::PeerChange> changes_;  ///< with the lock
  ride::Subscription watch_;
};

PeerView::PeerView(ride::Peer& peer) : PeerView(peer, Inspector::kName) {}

PeerView::PeerView(ride::Peer& peer, const std::string& inspector)
    : client_(std::make_unique<Client>(peer, inspector)) {}

PeerView::~PeerView() = default;

std::vector<std::string> PeerView::component_names() {
  if (client_->names.empty()) {
    for (const inspect::ComponentStatus& one : components()) client_->names.push_back(one.name);
  }
  return client_->names;
}

inspect::ApplicationStatus PeerView::status() {
  return told_by(client_->inspector.application(kPatient));
}

std::vector<inspect::ComponentStatus> PeerView::components(const Which& which) {
  std::vector<inspect::ComponentStatus> all;
  if (client_->has_application()) {
    all = all_told_by(client_->inspector.components(kPatient));
  } else {
    for (const ride::PeerComponent& one : client_->hosted()) {
      inspect::ComponentStatus& status = all.emplace_back();
      status.name = one.name;
      status.model = one.interface;
    }
  }
  keep_only(all, which);
  return all;
}

inspect::Faults PeerView::faults(const Which& which) {
  inspect::Faults faults = told_by(client_->inspector.faults(kPatient));
  keep_only(faults.components, which);
  return faults;
}

ComponentDescription PeerView::describe(const std::string& component, inspect::Values values) {
  const bool with_values = values == inspect::Values::kIncluded;
  const auto known = client_->known.find(component);
  if (!with_values && known != client_->known.end()) return known->second;
  ComponentDescription now = told_by(client_->inspector.describe(component, kPatient));
  const ComponentDescription& bare = client_->known[component] = without_values(now);
  return with_values ? now : bare;
}

std::vector<inspect::Connection> PeerView::connections(const Which& which) {
  auto all = all_told_by(client_->inspector.connections(kPatient));
  std::erase_if(all, [&](const inspect::Connection& one) {
    return !which(inspect::component_of_end(one.from)) || !which(inspect::component_of_end(one.to));
  });
  return all;
}

std::vector<inspect::ItemValue> PeerView::read(const std::vector<std::string>& items) {
  return all_told_by(client_->inspector.read(items, kPatient));
}

inspect::ItemValue PeerView::write(const std::string& item, const std::string& value) {
  return told_by(client_->inspector.write(item, value, kPatient));
}

inspect::CallResult PeerView::call(const std::string& component, const std::string& operation,
                                   const std::vector<std::string>& arguments) {
  return told_by(client_->inspector.call(component, operation, arguments, kPatient));
}

inspect::CommandStatus PeerView::begin(const std::string& component, const std::string& command,
                                       const std::vector<std::string>& arguments) {
  return told_by(client_->inspector.begin(component, command, arguments, kPatient));
}

inspect::CommandStatus PeerView::follow(std::int32_t handle) {
  return told_by(client_->inspector.follow(handle, kPatient));
}

inspect::CommandStatus PeerView::cancel(std::int32_t handle) {
  return told_by(client_->inspector.cancel(handle, kPatient));
}

inspect::ComponentStatus PeerView::change(const std::string& component,
                                          inspect::LifeCycleChange change) {
  return told_by(
      client_->inspector.change(component, std::string(types::name_of(change)), kPatient));
}

inspect::Watch PeerView::watch(const std::vector<std::string>& items, base::Duration interval) {
  return told_by(client_->inspector.watch(items, base::to_seconds(interval), kPatient));
}

inspect::WatchedValues PeerView::watched(std::int32_t handle) {
  return told_by(client_->inspector.watched(handle, kPatient));
}

void PeerView::end_watch(std::int32_t handle) {
  taken(client_->inspector.end_watch(handle, kPatient));
}

inspect::Cycle PeerView::cycle(const std::string& thread, const Which& which) {
  inspect::Cycle cycle = told_by(client_->inspector.cycle(thread, kPatient));
  for (inspect::CycleStep& step : cycle.steps) {
    if (!which(step.component)) step.component.clear();
  }
  return cycle;
}

inspect::LogLines PeerView::log(std::uint64_t after, const Which& which) {
  inspect::LogLines log = told_by(client_->inspector.log(after, kPatient));
  log.left_out +=
      std::erase_if(log.lines, [&](const exec::LogLine& line) { return !which(line.component); });
  return log;
}

exec::Pace PeerView::pace() { return told_by(client_->inspector.pace(kPatient)); }

exec::Pace PeerView::set_pace(const exec::Pace& pace) {
  return told_by(client_->inspector.set_pace(internal::to_wire(pace), kPatient));
}

exec::Pace PeerView::step() { return told_by(client_->inspector.step(kPatient)); }

bool PeerView::has_application() { return client_->has_application(); }

const std::string& PeerView::address() const { return client_->peer.address(); }

bool PeerView::connected() const { return client_->peer.connected(); }

base::Result<void> PeerView::wait_until_connected(base::Duration limit) const {
  const auto there = client_->peer.wait_until_connected(limit);
  if (!there) return base::Error{harmless(there.error())};
  return {};
}

std::vector<ride::PeerChange> PeerView::take_changes() { return client_->take_changes(); }

void PeerView::forget() { client_->forget(); }

}  // namespace armature::remote
