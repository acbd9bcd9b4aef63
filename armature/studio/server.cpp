// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/server.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/policy.hpp"
#include "armature/studio/internal/relay.hpp"
#include "armature/studio/internal/workbench.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::studio {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using namespace internal;

constexpr const char* kRunName = "run";
constexpr base::Duration kRunPeriod = 100ms;
constexpr base::Duration kSeatPeriod = 250ms;
constexpr base::Duration kDiskPeriod = 1s;

/// A short name for a long path (FNV-1a).
std::string name_for(const std::string& path) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : path) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// The folder of a deployment among those that studios have left.
std::string folder_of(const ServerOptions& options, base::Diagnostics& diagnostics) {
  std::error_code failure;
  const fs::path file = fs::weakly_canonical(options.file, failure);
  const fs::path folder = fs::path(options.folder) / name_for(file.string());
  fs::create_directories(folder, failure);
  if (failure) {
    diagnostics.error({}, "cannot make the folder '" + folder.string() + "': " + failure.message());
    return {};
  }
  // What lets pages in, logs of runs, and a socket by which they are commanded: for nobody else.
  fs::permissions(folder, fs::perms::owner_all, failure);
  if (failure) {
    diagnostics.error({}, "cannot keep the folder '" + folder.string() +
                              "' for this account alone: " + failure.message());
    return {};
  }
  return folder.string();
}

/// Something to be done each `period`.
class Every {
 public:
  explicit Every(base::Duration period) : period_(period) {}
  bool is_due(base::Time now) {
    if (now < due_) return false;
    due_ = now + period_;
    return true;
  }

 private:
  const base::Duration period_;
  base::Time due_ = base::Time::min();
};

class StudioServer final : public Server {
 public:
  StudioServer(const ServerOptions& options, std::string folder, platform::FolderLock lock,
               std::unique_ptr<platform::Poller> poller,
               std::shared_ptr<websocket::Transport> transport, ride::NodeOptions node)
      : lock_(std::move(lock)),
        poller_(std::move(poller)),
        transport_(std::move(transport)),
        desk_({options.file, options.program, options.arguments, std::move(folder)},
              {[this] { project_changed_ = true; }, [this] { run_changed_ = true; }}),
        relay_(kRunName, seat_, [this] { poller_->wake(); }),
        stops_(relay_, desk_.run()),
        workbench_(desk_, seat_, stops_, queue_, [this] { poller_->wake(); }),
        node_(std::move(node)) {}

  ~StudioServer() override {
    queue_.close();
    node_.remove(workbench_);
    node_.remove(relay_);
    relay_.disconnect();  // whose answers the rest is told
  }

  bool listen(const std::string& address, base::Diagnostics& diagnostics) {
    for (const auto& added :
         {node_.add(Workbench::kName, workbench_), node_.add(kRunName, relay_)}) {
      if (!added) diagnostics.error({}, added.error());
    }
    const auto listens = node_.listen(address);
    if (!listens) diagnostics.error({}, listens.error());
    return diagnostics.ok();
  }

  std::vector<std::string> pages() const override { return transport_->pages(); }

  void serve(base::Duration limit) override {
    watch_checker();
    const base::Duration most = std::min(limit, desk_.run().is_over() ? kSeatPeriod : kRunPeriod);
    const bool answered = !poller_->wait(most).empty();
    queue_.run();
    if (answered) desk_.checker().take();
    const base::Time now = platform::monotonic_now();
    if (look_at_run_.is_due(now)) {
      desk_.look_at_run();
      relay_.cancel_lost(now);
    }
    if (look_at_disk_.is_due(now)) desk_.look_at_disk();
    stops_.look(now);
    follow_run();
    if (seat_.look(now)) workbench_.tell_seat(seat_.holder());
    if (std::exchange(project_changed_, false)) workbench_.tell_project();
    if (std::exchange(run_changed_, false)) workbench_.tell_run();
  }

  int running() const override { return desk_.run().is_over() ? 0 : desk_.run().process(); }

 private:
  /// Another process may check than at the last turn.
  void watch_checker() {
    const Checker& checker = desk_.checker();
    // The descriptor of one that is gone is closed, and with that not watched any more.
    if (std::exchange(watched_, checker.process()) == checker.process()) return;
    if (watched_ != 0) poller_->add(checker.descriptor(), 0, {.read = true});
  }

  /// Pages reach the run's inspector as long as there is one.
  void follow_run() {
    const bool over = desk_.run().is_over();
    if (over && std::exchange(connected_, false)) relay_.disconnect();
    if (!over && !std::exchange(connected_, true)) relay_.connect(desk_.run().address());
    relay_.learn();
    if (desk_.run().stage() != RunStage::kStarting || !relay_.ready()) return;
    desk_.run().set_answers();
    run_changed_ = true;
  }

  const platform::FolderLock lock_;
  const std::unique_ptr<platform::Poller> poller_;
  const std::shared_ptr<websocket::Transport> transport_;
  bool project_changed_ = false;
  bool run_changed_ = false;
  int watched_ = 0;  ///< the process
  Every look_at_run_{kRunPeriod};
  Every look_at_disk_{kDiskPeriod};
  remote::ControlQueue queue_;
  Desk desk_;
  bool connected_ = false;  ///< the relay, to the run
  Seat seat_;
  Relay relay_;
  EmergencyStops stops_;
  Workbench workbench_;
  ride::Node node_;
};

/// Without a policy whoever has the page's address may do all.
std::function<bool(const ride::AccessQuestion&)> allowance(const std::string& policy_file,
                                                           base::Diagnostics& diagnostics) {
  if (policy_file.empty()) return [](const ride::AccessQuestion&) { return true; };
  ride::Policy policy = ride::Policy::load(policy_file, diagnostics);
  policy.check({Workbench::kName, kRunName}, diagnostics);
  return [policy](const ride::AccessQuestion& question) { return policy.allows(question); };
}

}  // namespace

std::unique_ptr<Server> Server::make(const ServerOptions& options, base::Diagnostics& diagnostics) {
  const std::string folder = folder_of(options, diagnostics);
  if (folder.empty()) return nullptr;
  auto lock = platform::FolderLock::take(folder);
  if (!lock)
    diagnostics.error({}, "another studio has '" + options.file + "' open: " + lock.error());
  auto poller = platform::Poller::make();
  if (!poller) diagnostics.error({}, poller.error());
  auto transport = websocket::make_transport({.pages = options.pages,
                                              .certificate = options.certificate,
                                              .key = options.key,
                                              .secrets = (fs::path(folder) / "entry").string()},
                                             diagnostics);
  ride::NodeOptions node;
  node.name = "studio";
  node.log = options.log;
  node.allows = allowance(options.policy, diagnostics);
  node.transports.push_back(transport);
  if (!diagnostics.ok()) return nullptr;
  auto server = std::make_unique<StudioServer>(options, folder, std::move(lock.value()),
                                               std::move(poller.value()), std::move(transport),
                                               std::move(node));
  if (!server->listen(options.listen, diagnostics)) return nullptr;
  return server;
}

}  // namespace armature::studio

extern "C" {
extern armature::studio::MakeServer* const armature_studio_make_server;
armature::studio::MakeServer* const armature_studio_make_server = &armature::studio::Server::make;
}
