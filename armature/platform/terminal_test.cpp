// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/terminal.hpp"

#include <array>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace armature::platform {
namespace {

using namespace std::chrono_literals;

/// A pseudo-terminal: what is written to `keyboard` is typed into `terminal`.
struct PseudoTerminal {
  PseudoTerminal() {
    keyboard = ::posix_openpt(O_RDWR | O_NOCTTY);
    ::grantpt(keyboard);
    ::unlockpt(keyboard);
    terminal = ::open(::ptsname(keyboard), O_RDWR | O_NOCTTY);
  }
  ~PseudoTerminal() {
    ::close(terminal);
    ::close(keyboard);
  }
  int keyboard;
  int terminal;
};

TEST(Terminal, IsToldFromAPipeAndHasAWidth) {
  const PseudoTerminal both;
  ASSERT_GE(both.terminal, 0);
  winsize size{24, 60, 0, 0};
  ASSERT_EQ(::ioctl(both.terminal, TIOCSWINSZ, &size), 0);
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  EXPECT_TRUE(is_terminal(both.terminal));
  EXPECT_EQ(terminal_width(both.terminal, 80), 60);
  EXPECT_FALSE(is_terminal(pipe[0]));
  EXPECT_EQ(terminal_width(pipe[0], 80), 80);
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(Terminal, IsReadWhenSomethingIsThereAndAtItsEnd) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  EXPECT_FALSE(wait_readable(pipe[0], 0ms));
  ASSERT_EQ(::write(pipe[1], "abc", 3), 3);
  EXPECT_TRUE(wait_readable(pipe[0], 1h));
  EXPECT_EQ(read_some(pipe[0], 2), "ab");
  EXPECT_EQ(read_some(pipe[0], 8), "c");
  ::close(pipe[1]);
  EXPECT_TRUE(wait_readable(pipe[0], 1h));
  EXPECT_EQ(read_some(pipe[0], 8), "");
  ::close(pipe[0]);
}

TEST(Terminal, GivesSingleKeysAndIsGivenBackAsItWas) {
  const PseudoTerminal both;
  termios before{};
  ASSERT_EQ(::tcgetattr(both.terminal, &before), 0);
  {
    const SingleKeys keys(both.terminal);
    ASSERT_EQ(::write(both.keyboard, "q", 1), 1);
    EXPECT_TRUE(wait_readable(both.terminal, 1s)) << "although no line has ended";
  }
  termios after{};
  ASSERT_EQ(::tcgetattr(both.terminal, &after), 0);
  EXPECT_EQ(after.c_lflag, before.c_lflag);
}

volatile std::sig_atomic_t handled_by_the_program = 0;

TEST(InterruptSignal, IsAFlagUntilItIsTakenAndGivesTheSignalBack) {
  const auto before = std::signal(SIGINT, [](int) { handled_by_the_program = 1; });
  {
    InterruptSignal interrupt;
    EXPECT_FALSE(interrupt.received());
    std::raise(SIGINT);
    EXPECT_TRUE(interrupt.received());
    EXPECT_TRUE(interrupt.take());
    EXPECT_FALSE(interrupt.take());
    std::raise(SIGTSTP);  // would suspend this process
    std::raise(SIGHUP);   // would end it
  }
  EXPECT_EQ(handled_by_the_program, 0);
  std::raise(SIGINT);
  EXPECT_EQ(handled_by_the_program, 1);
  std::signal(SIGINT, before);
}

}  // namespace
}  // namespace armature::platform
