// SPDX-License-Identifier: Apache-2.0
// A node for others to attack: listens at TCP and TLS, prints both addresses and then its log, and
// ends with its standard input.
//
// usage: ride_hostile_server FOLDER_OF_CERTIFICATES [large [patient]]
//
// It takes little; with `large` as much as a node takes by default. A message has to end within 0.3
// s; with `patient` within 5 s, so that a slow machine, too, receives several large ones at a time.
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <poll.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/ride/policy.hpp"
#include "robot.hpp"

namespace {

using namespace hostile;
using namespace std::chrono_literals;

class Robot : public ride::Service {
 public:
  Robot() : Service(kRobot) {}
  void tick(std::int32_t number) { publish(Tick{number}); }
  std::atomic<const ride::Node*> node{nullptr};

 private:
  ride::Executed execute(ride::Number operation, ride::Decoder& parameters,
                         ride::Reply& reply) override {
    std::string text;
    std::vector<std::string> texts;
    if (operation == kCount && parameters.take(texts) && parameters.ended()) {
      reply.put(static_cast<std::int32_t>(texts.size()));
      return ride::Executed::kDone;
    }
    if (operation == kEcho && parameters.take(text) && parameters.ended()) {
      reply.put(text);
    } else if (operation == kEcho || !parameters.ended()) {
      return ride::Executed::kMalformed;
    } else if (operation == kMessages) {
      reply.put(node.load()->statistics().messages);
    } else if (operation == kMoves) {
      reply.put(moves_);
    } else if (operation == kMove) {
      ++moves_;
      reply.done();
    } else {
      return ride::Executed::kNoSuchOperation;
    }
    return ride::Executed::kDone;
  }

  std::uint64_t moves_ = 0;
};

ride::NodeOptions options_of(const std::string& folder, bool large, bool patient) {
  armature::base::Diagnostics diagnostics;
  ride::NodeOptions options;
  if (!large) {
    options.limits.body_bytes = 1 << 20;
    options.limits.unsent_bytes = 256 << 10;
  }
  options.limits.time_to_complete = patient ? 5s : 300ms;
  options.transports = {tls_of(folder, "robot")};
  options.allows = [policy = ride::Policy::parse("allow local read robot\n"
                                                 "allow *@tls read robot\n"
                                                 "allow operator@tls command robot\n",
                                                 "policy", diagnostics)](
                       const ride::AccessQuestion& question) { return policy.allows(question); };
  options.log = [](const armature::rt::LogRecord& record) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    std::printf("%s\n", record.message().c_str());
    std::fflush(stdout);
  };
  return options;
}

bool input_has_ended() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  return ::poll(&input, 1, 0) > 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  Robot robot;
  ride::Node node(options_of(arguments[1], count > 2, count > 3));
  robot.node = &node;
  const auto plain = node.listen("tcp://127.0.0.1:0");
  const auto tls = node.listen("tls://127.0.0.1:0");
  if (!plain || !tls || !node.add("robot", robot)) return 1;
  std::printf("%s %s\n", plain.value().text().c_str(), tls.value().text().c_str());
  std::fflush(stdout);
  auto next = armature::platform::monotonic_now();
  for (std::int32_t number = 1; !input_has_ended(); ++number) {
    robot.tick(number);
    armature::platform::sleep_until(next += 1ms);
  }
  node.remove(robot);
}
