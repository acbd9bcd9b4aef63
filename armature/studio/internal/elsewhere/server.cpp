// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/elsewhere/server.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "armature/platform/clock.hpp"
#include "armature/platform/sockets/poller.hpp"
#include "armature/studio/internal/elsewhere/bench.hpp"
#include "armature/studio/internal/entrance.hpp"
#include "armature/studio/internal/every.hpp"
#include "armature/studio/internal/foxglove_companion.hpp"
#include "armature/studio/internal/relay.hpp"

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration kLookPeriod = 100ms;
/// For the first connection; those that are lost are waited for as long as it takes.
constexpr base::Duration kConnectionLimit = 3s;

std::vector<std::string> checker_command(const ServerOptions& options) {
  std::vector<std::string> command{options.program, "check", "--serve"};
  command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  return command;
}

class ElsewhereServer final : public Server {
 public:
  /// @param application  was found, and wakes the poller
  ElsewhereServer(const ServerOptions& options, Entrance entrance,
                  std::unique_ptr<platform::Poller> poller, std::unique_ptr<Elsewhere> application)
      : lock_(std::move(*entrance.lock)),
        poller_(std::move(poller)),
        messages_(std::move(entrance.messages)),
        transport_(std::move(entrance.transport)),
        checker_(checker_command(options)),
        application_(std::move(application)),
        relay_(kRunName, seat_, [this] { poller_->wake(); }),
        stops_(relay_, [this](const std::string& why) { return cannot_stop(why); }),
        bench_(
            *application_, checker_, [this] { return relay_.ready(); }, seat_, stops_, queue_,
            [this] { poller_->wake(); }),
        node_(std::move(entrance.node)),
        foxglove_(messages_, foxglove_options()) {}

  ~ElsewhereServer() override {
    queue_.close();
    node_.remove(bench_);
    node_.remove(relay_);
    relay_.disconnect();  // whose answers the rest is told
  }

  bool begin(const std::string& listen, base::Diagnostics& diagnostics) {
    follow_application();
    for (const auto& added :
         {node_.add(OperatorsBench::kName, bench_), node_.add(kRunName, relay_)}) {
      if (!added) diagnostics.error({}, added.error());
    }
    const auto listens = node_.listen(listen);
    if (!listens) diagnostics.error({}, listens.error());
    return diagnostics.ok();
  }

  std::vector<std::string> pages() const override { return transport_->pages(); }
  std::vector<std::string> foxglove() const override { return messages_->addresses(); }

  void serve(base::Duration limit) override {
    watch_checker();
    const bool answered = !poller_->wait(std::min(limit, kLookPeriod)).empty();
    queue_.run();
    if (answered) checker_.take();
    const base::Time now = platform::monotonic_now();
    if (look_.is_due(now)) relay_.cancel_lost(now);
    stops_.look(now);
    follow_application();
    if (seat_.look(now)) bench_.tell_seat(seat_.holder());
  }

  int running() const override { return 0; }

 private:
  base::Result<void> cannot_stop(const std::string& why) const {
    return base::Error{why + ", and what runs at " + application_->address() +
                       " is not stopped from here"};
  }

  /// Another process may answer than at the last turn.
  void watch_checker() {
    // The descriptor of one that is gone is closed, and with that not watched any more.
    if (std::exchange(watched_, checker_.process()) == checker_.process()) return;
    if (watched_ != 0) poller_->add(checker_.descriptor(), 0, {.read = true});
  }

  /// Pages reach its inspector as long as it is there; each time that it comes it is another one.
  void follow_application() {
    const Elsewhere::State now = application_->state();
    const Elsewhere::State before = std::exchange(known_, now);
    const bool came = now.there && (!before.there || now.number != before.number);
    if (came) relay_.connect(application_->peer());
    if (!now.there && before.there) relay_.disconnect();
    relay_.learn();
    const bool ready = relay_.ready();
    const bool other_run = std::exchange(ready_, ready) != ready;
    if (now.version != before.version || now.there != before.there) bench_.tell_project();
    if (other_run || now != before) bench_.tell_run();
  }

  const platform::FolderLock lock_;
  const std::unique_ptr<platform::Poller> poller_;
  const std::shared_ptr<websocket::Messages> messages_;
  const std::shared_ptr<websocket::Transport> transport_;
  int watched_ = 0;  ///< the checker's process
  Every look_{kLookPeriod};
  remote::ControlQueue queue_;
  Checker checker_;
  const std::unique_ptr<Elsewhere> application_;
  Elsewhere::State known_;
  bool ready_ = false;
  Seat seat_;
  Relay relay_;
  EmergencyStops stops_;
  ElsewhereBench bench_;
  ride::Node node_;
  foxglove::Server foxglove_;
};

}  // namespace

std::unique_ptr<Server> make_elsewhere_server(const ServerOptions& options,
                                              base::Diagnostics& diagnostics) {
  auto poller = platform::Poller::make();
  if (!poller) {
    diagnostics.error({}, poller.error());
    return nullptr;
  }
  auto application = std::make_unique<Elsewhere>(Elsewhere::Options{
      options.file, options.transports, options.log, [&woken = *poller.value()] { woken.wake(); }});
  if (const auto found = application->find(kConnectionLimit); !found) {
    diagnostics.error({}, found.error());
    return nullptr;
  }
  auto entrance = make_entrance(options, options.file, diagnostics);
  if (!entrance) return nullptr;
  auto server = std::make_unique<ElsewhereServer>(
      options, std::move(*entrance), std::move(poller.value()), std::move(application));
  if (!server->begin(options.listen, diagnostics)) return nullptr;
  return server;
}

}  // namespace armature::studio::internal
