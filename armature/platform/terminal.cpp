// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/terminal.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>

#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace armature::platform {
namespace {

std::atomic<bool> interrupted{false};
struct sigaction previous_interrupt;
struct sigaction previous_suspend;
struct sigaction previous_hang_up;

void on_interrupt(int) { interrupted = true; }

}  // namespace

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

int terminal_width(int descriptor, int otherwise) {
  winsize size{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : otherwise;
}

bool wait_readable(int descriptor, base::Duration limit) {
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(limit).count();
  pollfd input{.fd = descriptor, .events = POLLIN, .revents = 0};
  return ::poll(&input, 1, static_cast<int>(std::clamp<std::int64_t>(ms, 0, 1000))) > 0;
}

std::optional<std::string> read_some(int descriptor, std::size_t most) {
  std::string text(most, '\0');
  const ssize_t count = ::read(descriptor, text.data(), text.size());
  if (count < 0 && errno == EINTR) return std::nullopt;
  text.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
  return text;
}

InterruptSignal::InterruptSignal() {
  interrupted = false;
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, &previous_interrupt);
  action.sa_handler = SIG_IGN;
  sigaction(SIGTSTP, &action, &previous_suspend);
  sigaction(SIGHUP, &action, &previous_hang_up);
  // Whoever is asked to stop by it is so still.
  if (previous_hang_up.sa_handler != SIG_DFL) sigaction(SIGHUP, &previous_hang_up, nullptr);
}

InterruptSignal::~InterruptSignal() {
  sigaction(SIGINT, &previous_interrupt, nullptr);
  sigaction(SIGTSTP, &previous_suspend, nullptr);
  sigaction(SIGHUP, &previous_hang_up, nullptr);
}

bool InterruptSignal::received() const { return interrupted; }

bool InterruptSignal::take() { return interrupted.exchange(false); }

struct SingleKeys::Settings {
  termios content;
};

SingleKeys::SingleKeys(int descriptor) : descriptor_(descriptor) {
  Settings now{};
  if (::tcgetattr(descriptor, &now.content) != 0) return;
  before_ = std::make_unique<Settings>(now);
  now.content.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  now.content.c_cc[VMIN] = 1;
  now.content.c_cc[VTIME] = 0;
  ::tcsetattr(descriptor, TCSADRAIN, &now.content);
}

SingleKeys::~SingleKeys() {
  if (before_) ::tcsetattr(descriptor_, TCSADRAIN, &before_->content);
}

}  // namespace armature::platform
