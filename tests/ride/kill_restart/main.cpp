// SPDX-License-Identifier: Apache-2.0
// Either side is killed and started again, over and over, in the middle of calls, commands and
// events. The side that lives leaks nothing, no call of it hangs, no event and no command comes
// twice, and every gap is told.
//
// usage: ride_kill_restart CYCLES
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <malloc.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "armature/testing/kept_port.hpp"
#include "counter.hpp"
#include "survivor.hpp"

namespace {

using namespace kill_restart;

ride::NodeOptions impatient() {
  ride::NodeOptions options;
  options.reconnection.first = 1ms;
  options.reconnection.most = 4ms;
  return options;
}

class Moments {
 public:
  /// In one of four lives death comes at any moment, connecting included.
  bool is_any() { return random_() % 4 == 0; }
  void wait(base::Duration most) {
    const auto part = static_cast<base::Duration::rep>(random_() % 1000);
    platform::sleep_until(platform::monotonic_now() + most * part / 1000);
  }

 private:
  std::mt19937 random_{1};
};

/// Lives until a tenth have been: only then what is kept for later is there.
bool is_warm(std::uint32_t life, std::uint32_t lives) { return life == lives / 10; }

void server_dies(const std::string& address, std::uint32_t lives) {
  Watch watch;
  ride::Node node(impatient());
  ride::Peer& peer = node.connect(address);
  const auto told = peer.on_change([&](const ride::PeerChange& to) { watch.change(to.connected); });
  RemoteCounter counter(peer);
  const auto numbers = counter.on_numbered([&](const Numbered& event) { watch.take(event); });
  Caller echoes([&] { return counter.echo(1).code(); });
  Caller nevers([&] { return counter.never().code(); });
  Moments moments;
  Taken before;
  for (std::uint32_t life = 1; life <= lives; ++life) {
    const std::uint64_t answered = echoes.answered;
    Child server("server", address, life);
    if (moments.is_any()) {
      moments.wait(5ms);
    } else {
      wait_until(
          [&] { return watch.life == life && echoes.answered > answered && peer.connected(); },
          "an event and an answer of life " + std::to_string(life));
      moments.wait(1ms);
    }
    server.kill();
    wait_until([&] { return !peer.connected(); }, "the loss of life " + std::to_string(life));
    if (is_warm(life, lives)) before = Taken::now();
  }
  check_level(before, Taken::now());
  echoes.end();
  nevers.end();
  std::printf(
      "  %llu events, %llu losses told, %llu answers, %llu calls broken off, and %llu of those "
      "that "
      "are never answered\n",
      static_cast<unsigned long long>(watch.taken), static_cast<unsigned long long>(watch.losses),
      static_cast<unsigned long long>(echoes.answered),
      static_cast<unsigned long long>(echoes.failed),
      static_cast<unsigned long long>(nevers.failed));
  if (nevers.answered != 0) fail("an answer came that nobody has given");
  if (nevers.failed == 0 || watch.taken == 0) fail("nothing has happened");
}

void client_dies(const std::string& address, std::uint32_t lives) {
  Counter counter;
  ride::Node node(impatient());
  serve(node, counter, address);
  std::atomic<bool> goes_on{true};
  std::thread raising([&] { raise_numbers(node, counter, 1, [&] { return goes_on.load(); }); });
  Moments moments;
  Taken before;
  for (std::uint32_t life = 1; life <= lives; ++life) {
    const int nevers = counter.nevers;
    const std::uint64_t notes = counter.notes;
    Child client("client", address, life);
    if (moments.is_any()) {
      moments.wait(5ms);
    } else {
      wait_until([&] { return counter.nevers > nevers && counter.notes > notes; },
                 "a call and a command of life " + std::to_string(life));
      moments.wait(1ms);
    }
    client.kill();
    wait_until([&] { return node.statistics().connections == 0; },
               "the end of the connection of life " + std::to_string(life));
    counter.forget_kept();
    if (is_warm(life, lives)) before = Taken::now();
  }
  check_level(before, Taken::now());
  goes_on = false;
  raising.join();
  node.remove(counter);
  std::printf("  %llu commands, none twice; %d requests were open\n",
              static_cast<unsigned long long>(counter.notes), counter.nevers.load());
}

[[noreturn]] void be_server(const std::string& address, std::uint32_t life) {
  Counter counter;
  ride::Node node;
  serve(node, counter, address);
  raise_numbers(node, counter, life, [] { return true; });
  std::abort();
}

[[noreturn]] void be_client(const std::string& address, std::uint32_t life) {
  Watch watch;
  ride::Node node(impatient());
  ride::Peer& peer = node.connect(address);
  if (const auto there = peer.wait_until_connected(kPatience); !there) fail(there.error());
  RemoteCounter counter(peer);
  const auto numbers = counter.on_numbered([&](const Numbered& event) { watch.take(event); });
  Caller nevers([&] { return counter.never().code(); });
  for (std::uint32_t number = 1;; ++number) {
    if (counter.note(life, number) != ride::Sent::kYes) fail("a command was not sent");
    if (!counter.echo(number)) fail("no answer");
  }
}

void run(const char* what, void (*scene)(const std::string&, std::uint32_t),
         const std::string& address, std::uint32_t lives) {
  std::printf("%s, %s: %u times\n", what, address.substr(0, address.find(':')).c_str(), lives);
  const auto begin = platform::monotonic_now();
  scene(address, lives);
  const auto took = std::chrono::duration<double>(platform::monotonic_now() - begin);
  std::printf("  %.1f s\n", took.count());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments, arguments + count);
  if (count == 4) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const auto life = static_cast<std::uint32_t>(std::stoul(words[3]));
    words[1] == "server" ? be_server(words[2], life) : be_client(words[2], life);
  }
  if (count != 2) return 2;
  ::mallopt(M_ARENA_MAX, 1);  // the figures are those of one arena
  const auto each = static_cast<std::uint32_t>(std::stoul(words[1]) / 4);
  const std::string file = "unix:" + std::filesystem::temp_directory_path().string() +
                           "/ride_kill_restart_" + std::to_string(::getpid());
  const armature::testing::KeptPort port;
  run("the server dies", server_dies, port.address(), each);
  run("the server dies", server_dies, file, each);
  run("the client dies", client_dies, port.address(), each);
  run("the client dies", client_dies, file, each);
  std::filesystem::remove(file.substr(5));
}
