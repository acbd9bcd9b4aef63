// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/server.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/node.hpp"
#include "armature/studio/internal/elsewhere/server.hpp"
#include "armature/studio/internal/entrance.hpp"
#include "armature/studio/internal/every.hpp"
#include "armature/studio/internal/foxglove_companion.hpp"
#include "armature/studio/internal/relay.hpp"
#include "armature/studio/internal/workbench.hpp"

namespace armature::studio {
namespace {

using namespace std::chrono_literals;
using namespace internal;

constexpr base::Duration kRunPeriod = 100ms;
constexpr base::Duration kSeatPeriod = 250ms;
constexpr base::Duration kDiskPeriod = 1s;

class StudioServer final : public Server {
 public:
  StudioServer(const ServerOptions& options, Entrance entrance,
               std::unique_ptr<platform::Poller> poller)
      : lock_(std::move(*entrance.lock)),
        poller_(std::move(poller)),
        messages_(std::move(entrance.messages)),
        transport_(std::move(entrance.transport)),
        desk_({options.file, options.program, options.arguments, entrance.folder},
              {[this] { project_changed_ = true; }, [this] { run_changed_ = true; }}),
        relay_(kRunName, seat_, [this] { poller_->wake(); }),
        stops_(relay_, [this](const std::string&) { return desk_.run().stop(); }),
        workbench_(desk_, seat_, stops_, queue_, [this] { poller_->wake(); }),
        node_(std::move(entrance.node)),
        foxglove_(messages_, foxglove_options()) {}

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
  std::vector<std::string> foxglove() const override { return messages_->addresses(); }

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
  const std::shared_ptr<websocket::Messages> messages_;
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
  foxglove::Server foxglove_;
};

std::unique_ptr<Server> make_file_server(const ServerOptions& options,
                                         base::Diagnostics& diagnostics) {
  std::error_code unknown;
  const auto path = std::filesystem::weakly_canonical(options.file, unknown);
  auto entrance = make_entrance(options, path.string(), diagnostics);
  auto poller = platform::Poller::make();
  if (!poller) diagnostics.error({}, poller.error());
  if (!diagnostics.ok()) return nullptr;
  auto server =
      std::make_unique<StudioServer>(options, std::move(*entrance), std::move(poller.value()));
  if (!server->listen(options.listen, diagnostics)) return nullptr;
  return server;
}

}  // namespace

std::unique_ptr<Server> Server::make(const ServerOptions& options, base::Diagnostics& diagnostics) {
  return options.elsewhere ? make_elsewhere_server(options, diagnostics)
                           : make_file_server(options, diagnostics);
}

}  // namespace armature::studio

extern "C" {
extern armature::studio::MakeServer* const armature_studio_make_server;
armature::studio::MakeServer* const armature_studio_make_server = &armature::studio::Server::make;
}
