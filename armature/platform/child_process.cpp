// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/child_process.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace armature::platform {
namespace {

/// The two ends of a connection, which no other program inherits. A socket and no pipe: writing to
/// one that nobody reads any more can be an error instead of a signal.
struct Ends {
  Ends() { failed = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0; }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  ~Ends() {
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
  }
  int take(std::size_t end) { return std::exchange(ends[end], -1); }

  std::array<int, 2> ends{-1, -1};
  bool failed = false;
};

/// What becomes of the descriptors of a program that is started.
class Arrangement {
 public:
  Arrangement() {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
  }
  Arrangement(const Arrangement&) = delete;
  Arrangement& operator=(const Arrangement&) = delete;
  ~Arrangement() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  void pass(int from, int as) { ::posix_spawn_file_actions_adddup2(&actions_, from, as); }
  void open(int as, const std::string& path, int flags) {
    ::posix_spawn_file_actions_addopen(&actions_, as, path.c_str(), flags, 0600);
  }
  /// The program hears all signals, whatever this thread has blocked, and has a session of its own
  /// if it is lasting.
  void set_signals_and_session(bool lasting) {
    sigset_t none;
    sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    const int session = lasting ? POSIX_SPAWN_SETSID : 0;
    ::posix_spawnattr_setflags(&attributes_, static_cast<short>(POSIX_SPAWN_SETSIGMASK | session));
  }
  int start(int& id, const std::vector<std::string>& arguments) const {
    std::vector<char*> words;
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    // Asked first, as an emulated kernel does not tell what keeps a program from starting.
    if (::access(words[0], X_OK) != 0) return errno;
    return ::posix_spawn(&id, words[0], &actions_, &attributes_, words.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace

base::Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments,
                                               const ChildOptions& options) {
  Ends input;
  Ends output;
  if (input.failed || output.failed) return base::Error{"no sockets are to be had"};
  Arrangement arrangement;
  if (options.piped) {
    arrangement.pass(input.ends[0], STDIN_FILENO);
    arrangement.pass(output.ends[1], STDOUT_FILENO);
  } else {
    arrangement.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  }
  if (!options.log.empty()) {
    const int flags = O_WRONLY | O_CREAT | O_TRUNC | O_APPEND;
    arrangement.open(STDERR_FILENO, options.log, flags);
    if (!options.piped) arrangement.pass(STDERR_FILENO, STDOUT_FILENO);
  }
  arrangement.set_signals_and_session(options.lasting);
  int id = 0;
  if (const int error = arrangement.start(id, arguments); error != 0) {
    return base::Error{"cannot start '" + arguments.front() +
                       "': " + std::generic_category().message(error)};
  }
  if (!options.piped) return ChildProcess(id, -1, -1, options.lasting);
  const int read_end = output.take(0);
  ::fcntl(read_end, F_SETFL, O_NONBLOCK);
  return ChildProcess(id, input.take(1), read_end, options.lasting);
}

ChildProcess::ChildProcess(int id, int input, int output, bool lasting)
    : id_(id), input_(input), output_(output), lasting_(lasting) {}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept { *this = std::move(other); }

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(input_, other.input_);
  std::swap(output_, other.output_);
  std::swap(lasting_, other.lasting_);
  std::swap(exit_code_, other.exit_code_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (input_ >= 0) ::close(input_);
  if (output_ >= 0) ::close(output_);
  if (id_ == 0 || lasting_ || exit_code()) return;
  send(SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

std::optional<std::string> ChildProcess::read() {
  std::string text;
  std::array<char, 65536> part;
  while (true) {
    const ssize_t count = ::read(output_, part.data(), part.size());
    if (count > 0) {
      text.append(part.data(), static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else if (!text.empty() || (count < 0 && errno == EAGAIN)) {
      return text;
    } else {
      return std::nullopt;
    }
  }
}

bool ChildProcess::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::send(input_, text.data(), text.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return text.empty();
}

void ChildProcess::send(int signal) const {
  if (!exit_code_) ::kill(id_, signal);
}

std::optional<int> ChildProcess::exit_code() {
  int status = 0;
  if (!exit_code_ && ::waitpid(id_, &status, WNOHANG) == id_) {
    exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return exit_code_;
}

bool process_lives(int id) { return id > 0 && (::kill(id, 0) == 0 || errno == EPERM); }

bool process_has_argument(int id, std::string_view word) {
  std::ifstream file("/proc/" + std::to_string(id) + "/cmdline", std::ios::binary);
  for (std::string argument; std::getline(file, argument, '\0');) {
    if (argument == word) return true;
  }
  return false;
}

void send_signal(int id, int signal) {
  if (id > 0) ::kill(id, signal);
}

std::string own_program() {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/self/exe", failure).string();
}

}  // namespace armature::platform
