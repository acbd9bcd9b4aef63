// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/network.hpp"

#include <mutex>
#include <utility>

#include "armature/component/interface.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/remote/control_queue.hpp"
#include "armature/remote/exported_component.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/remote/internal/described_component.hpp"
#include "armature/remote/internal/transports.hpp"
#include "armature/remote/placeholder.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/policy.hpp"

namespace armature::remote {
namespace {

const std::vector<std::string> kTransportsToOthers{"tcp", "unix", "tls", "ws", "wss"};

/// Of `tcp://host:port/Name`.
struct RemoteAddress {
  std::string peer;
  std::string component;
};

base::Result<RemoteAddress> parse_remote(const std::string& text) {
  const std::size_t slash = text.rfind('/');
  const bool whole = slash != std::string::npos && slash + 1 < text.size() && slash > 0 &&
                     text[slash - 1] != '/' && text.find(':') < slash;
  if (!whole) {
    return base::Error{"'" + text +
                       "' must be the address of a process and the name of a component in it, such "
                       "as tcp://127.0.0.1:4242/Generator"};
  }
  RemoteAddress remote{text.substr(0, slash), text.substr(slash + 1)};
  const auto address = ride::Address::parse(remote.peer);
  if (!address) return base::Error{address.error()};
  if (const auto known = internal::check_transport(address.value(), kTransportsToOthers); !known) {
    return base::Error{known.error()};
  }
  return remote;
}

/// How the members of a prototype are called: as its file says, or as all of its model are.
std::unique_ptr<const InterfaceNumbers> numbers_of(const document::Component& written,
                                                   component::Component& prototype) {
  auto* const described = dynamic_cast<internal::DescribedComponent*>(&prototype);
  if (described != nullptr) return std::move(described->numbers);
  return std::make_unique<InterfaceNumbers>(written.model, component::interface_of(prototype));
}

/// More lines than that between two looks at them are left out.
constexpr std::size_t kMostLogLines = 256;

class RideNetwork final : public Network {
 public:
  explicit RideNetwork(const NetworkOptions& options) : options_(options) {}
  ~RideNetwork() override { RideNetwork::leave(); }

  base::Result<std::unique_ptr<component::Component>> make_placeholder(
      const document::Component& written,
      std::unique_ptr<component::Component> prototype) override {
    auto remote = parse_remote(written.remote.name);
    if (!remote) return base::Error{remote.error()};
    const RemoteAddress& there = remote.value();
    auto numbers = numbers_of(written, *prototype);
    Placeholder::Original original{std::move(prototype), std::move(numbers), there.component};
    return std::unique_ptr<component::Component>(std::make_unique<Placeholder>(
        written.name, std::move(original), there.peer,
        [this, address = there.peer]() -> ride::Peer& { return node().connect(address); }));
  }

  std::unique_ptr<component::Component> make_inlets(
      const std::vector<component::InputPortBase*>& inputs) override {
    auto inlets = std::make_unique<exec::Inlets>(document::kNetworkName, inputs);
    inlets_ = inlets.get();
    return inlets;
  }

  void check(const document::Document& document, base::Diagnostics& diagnostics) override {
    ride::NodeOptions options;
    internal::set_transports(document, document.network.listen, options_, options, diagnostics);
    set_policy(document, options, diagnostics);
    set_serving(document, options, diagnostics);
  }

  void open(const document::Document& document, const std::vector<std::string>& listen,
            exec::Application& application, base::Diagnostics& diagnostics) override {
    application_ = &application;
    ride::NodeOptions options;
    if (!document.application.empty()) options.name = document.application;
    options.log = [this](const rt::LogRecord& record) { note(record); };
    options.socket_mode = document.network.socket_mode.value_or(options.socket_mode);
    if (const auto memory = document.network.memory_kb) {
      options.limits.memory_bytes = static_cast<std::size_t>(*memory) * 1000;
    }
    base::Diagnostics found;
    std::vector<document::Reference> addresses = document.network.listen;
    for (const std::string& each : listen) addresses.push_back({each, {}});
    internal::set_transports(document, addresses, options_, options, found);
    set_policy(document, options, found);
    set_serving(document, options, found);
    if (found.ok()) {
      node_ = std::make_unique<ride::Node>(std::move(options));
      if (!addresses.empty()) host(application, found);
      for (const document::Reference& each : addresses) listen_at(each.name, each.where, found);
    }
    if (!found.ok()) {
      leave();
      node_.reset();
      addresses_.clear();
    }
    diagnostics.append(found);
    tell();
  }

  std::vector<std::string> addresses() const override { return addresses_; }

  void serve() override {
    queue_.run();
    if (inspector_ != nullptr) inspector_->serve();
    for (const Hosted& hosted : hosted_) {
      const std::uint64_t dropped = hosted.service->serve();
      if (dropped == 0) continue;
      say(hosted.service->component().name(), dropped);
    }
    tell();
  }

  void leave() override {
    queue_.close();
    for (const Hosted& hosted : hosted_) node().remove(*hosted.service);
    hosted_.clear();
    if (inspector_ != nullptr) node().remove(inspector_->service());
    inspector_.reset();
    tell();
  }

 private:
  struct Hosted {
    std::unique_ptr<InterfaceNumbers> numbers;
    std::unique_ptr<ExportedComponent> service;
  };

  void host(exec::Application& application, base::Diagnostics& diagnostics) {
    const auto tell = [this](const std::string& text) { say(text); };
    inspector_ = std::make_unique<Inspector>(application, queue_, tell);
    if (const auto added = node().add(Inspector::kName, inspector_->service()); !added) {
      diagnostics.error({}, added.error());
    }
    for (const exec::ComponentEntry& entry : application.blueprint().components) {
      auto numbers = std::make_unique<InterfaceNumbers>(entry.model,
                                                        component::interface_of(*entry.component));
      auto service = std::make_unique<ExportedComponent>(
          *numbers, *entry.component, application, queue_,
          [this, &application](component::InputPortBase& input, const types::Value& value) {
            return write_input(application, input, value);
          },
          tell);
      if (const auto added = node().add(entry.component->name(), *service); !added) {
        diagnostics.error(entry.where, added.error());
        continue;
      }
      hosted_.push_back({std::move(numbers), std::move(service)});
    }
  }

  ride::Node& node() {
    if (node_ == nullptr) node_ = std::make_unique<ride::Node>();
    return *node_;
  }

  /// Without a policy whoever reaches the node may look, and do nothing.
  void set_policy(const document::Document& document, ride::NodeOptions& options,
                  base::Diagnostics& diagnostics) const {
    ride::Policy policy = policy_of(document, diagnostics);
    if (!options_.policy.empty()) policy.add(ride::Policy::load(options_.policy, diagnostics));
    const bool all_may_look = document.network.policy.name.empty();
    options.allows = [policy, all_may_look](const ride::AccessQuestion& question) {
      const bool looks = question.access == ride::Access::kRead;
      return (all_may_look && looks) || policy.allows(question);
    };
  }

  static ride::Policy policy_of(const document::Document& document,
                                base::Diagnostics& diagnostics) {
    const document::Reference& file = document.network.policy;
    if (file.name.empty()) return {};
    ride::Policy policy = ride::Policy::load(document::path_from(document, file.name), diagnostics);
    std::vector<std::string> names{Inspector::kName};
    for (const document::Component& each : document.components) names.push_back(each.name);
    policy.check(names, diagnostics);
    return policy;
  }

  /// Others must not hold up the application's own threads, however much they ask for.
  static void set_serving(const document::Document& document, ride::NodeOptions& options,
                          base::Diagnostics& diagnostics) {
    const auto& serving = document.network.serving;
    if (!serving) return;
    options.serving = {.most = serving->most, .least = serving->least};
    for (const document::Component& each : document.components) {
      if (each.activity.priority == 0 || each.activity.priority > serving->most) continue;
      diagnostics.error(serving->where,
                        "serving with priority " + std::to_string(serving->most) +
                            " would hold up '" + each.name + "', which has " +
                            std::to_string(each.activity.priority),
                        "give serving: priorities below those of all components");
      return;
    }
  }

  void listen_at(const std::string& address, const base::Location& where,
                 base::Diagnostics& diagnostics) {
    const auto got = node().listen(address);
    if (got) {
      addresses_.push_back(got.value().text());
    } else {
      diagnostics.error(where, got.error());
    }
  }

  base::Result<void> write_input(exec::Application& application,
                                 const component::InputPortBase& input, const types::Value& value) {
    if (inlets_ != nullptr && inlets_->writes(input)) {
      return inlets_->write(application, input, value);
    }
    return base::Error{"'" + input.owner().name() + "." + input.name() +
                       "' is not open to other processes: list it in its deployment, network: "
                       "{inputs: [...]}"};
  }

  void say(const std::string& component, std::uint64_t dropped) {
    rt::LogRecord record = warning();
    record.format = "{} events and samples of '{}' came faster than they could be sent";
    record.take({dropped, std::string_view(component)});
    note(record);
  }

  void say(const std::string& text) {
    rt::LogRecord record = warning();
    record.format = "{}";
    record.take({std::string_view(text)});
    note(record);
  }

  rt::LogRecord warning() const {
    rt::LogRecord record;
    record.level = rt::LogLevel::kWarning;
    record.component = "network";
    record.time = application_->now();
    return record;
  }

  /// @thread any
  void note(const rt::LogRecord& record) {
    const std::lock_guard lock(log_mutex_);
    if (log_.size() < kMostLogLines) log_.push_back(record);
  }

  void tell() {
    std::vector<rt::LogRecord> lines;
    {
      const std::lock_guard lock(log_mutex_);
      lines.swap(log_);
    }
    if (!options_.log) return;
    for (const rt::LogRecord& line : lines) options_.log(line);
  }

  NetworkOptions options_;
  exec::Inlets* inlets_ = nullptr;
  exec::Application* application_ = nullptr;
  std::mutex log_mutex_;
  std::vector<rt::LogRecord> log_;  ///< since `serve` was called last
  ControlQueue queue_;
  std::unique_ptr<ride::Node> node_;
  std::vector<std::string> addresses_;
  std::vector<Hosted> hosted_;
  std::unique_ptr<Inspector> inspector_;
};

}  // namespace

std::unique_ptr<Network> make_network(const NetworkOptions& options) {
  return std::make_unique<RideNetwork>(options);
}

}  // namespace armature::remote
