// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/printer.hpp"

#include <array>
#include <optional>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/platform/terminal.hpp"

namespace armature::platform {
namespace {

constexpr base::Duration kLong = std::chrono::minutes(1);
constexpr base::Duration kShort = std::chrono::milliseconds(1);

/// Standard output is a pipe whose reader is this test.
class PipedOutput {
 public:
  PipedOutput() : saved_(::dup(kStandardOutput)) {
    survive_lost_outputs();
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    reader_ = ends[0];
    ::dup2(ends[1], kStandardOutput);
    ::close(ends[1]);
  }
  PipedOutput(const PipedOutput&) = delete;
  PipedOutput& operator=(const PipedOutput&) = delete;
  ~PipedOutput() {
    end();
    close_reader();
  }

  /// Standard output is what it was.
  void end() {
    if (saved_ < 0) return;
    ::dup2(saved_, kStandardOutput);
    ::close(saved_);
    saved_ = -1;
  }
  void close_reader() {
    if (reader_ >= 0) ::close(reader_);
    reader_ = -1;
  }
  std::string read(std::size_t bytes) const {
    std::string text;
    while (text.size() < bytes) {
      const auto more = read_some(reader_, bytes - text.size());
      if (!more || more->empty()) break;
      text += *more;
    }
    return text;
  }
  /// Until nobody reads, nothing more fits.
  static void fill() {
    const int flags = ::fcntl(kStandardOutput, F_GETFL);
    ::fcntl(kStandardOutput, F_SETFL, flags | O_NONBLOCK);
    const std::string much(4096, '.');
    while (::write(kStandardOutput, much.data(), much.size()) > 0) {
    }
    ::fcntl(kStandardOutput, F_SETFL, flags);
  }

 private:
  int saved_;
  int reader_ = -1;
};

TEST(Printer, WritesWhatIsPrintedInItsOrder) {
  const PipedOutput output;
  std::string all;
  {
    const Printer printer;
    for (int i = 0; i < 1000; ++i) {
      const std::string line = "line " + std::to_string(i) + "\n";
      print(kStandardOutput, line);
      all += line;
    }
    EXPECT_TRUE(Printer::flush(kLong));
  }
  EXPECT_EQ(output.read(all.size()), all);
}

TEST(Printer, HoldsUpNobodyIfNothingIsReadAndCountsWhatIsLost) {
  PipedOutput output;
  PipedOutput::fill();
  const std::uint64_t before = lost_lines();
  {
    const Printer printer;
    constexpr int kLines = 10'000;
    for (int i = 0; i < kLines; ++i) print(kStandardOutput, "a line that nobody reads\n");
    EXPECT_FALSE(Printer::flush(kShort));
    EXPECT_GT(lost_lines(), before);
    EXPECT_LT(lost_lines(), before + kLines);
    output.close_reader();
  }
  output.end();
}

TEST(Printer, LosesTheLinesOfAReaderThatIsGoneAndNothingElse) {
  PipedOutput output;
  output.close_reader();
  const std::uint64_t before = lost_lines();
  {
    const Printer printer;
    print(kStandardOutput, "one\ntwo\n");
    print(kStandardOutput, "three\n");
    EXPECT_TRUE(Printer::flush(kLong));
  }
  print(kStandardOutput, "four\n");
  output.end();
  EXPECT_EQ(lost_lines(), before + 4);
}

TEST(Printer, ATextLargerThanItsPartsArrivesWhole) {
  const PipedOutput output;
  const std::string text = std::string(20'000, 'x') + "\n";
  std::optional<Printer> printer(std::in_place);
  print(kStandardOutput, text);
  EXPECT_EQ(output.read(text.size()), text);
  printer.reset();
}

}  // namespace
}  // namespace armature::platform
