// SPDX-License-Identifier: Apache-2.0
// The real-time functions of ride.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/utf8.hpp"
#include "armature/ride/codec.hpp"
#include "armature/ride/wire.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::ride {
namespace {

TEST(RealtimeRide, Text) {
  bool valid = false;
  expect_realtime("base::is_utf8", [&] { valid = base::is_utf8("grüße"); });
  EXPECT_TRUE(valid);
}

TEST(RealtimeRide, Headers) {
  std::array<std::byte, Header::kSize> bytes{};
  const Header header{7, Type::kCommand, false, 28, 3};
  std::optional<Header> read;
  expect_realtime("ride::write_header", [&] { write_header(bytes.data(), header); });
  expect_realtime("ride::read_header", [&] { read = read_header(bytes.data()); });
  EXPECT_EQ(read, header);
}

TEST(RealtimeRide, Bodies) {
  Body body;
  body.reserve(1024);
  const std::vector<double> position{1, 2, 3};
  expect_realtime("Encoder", [&] {
    body.clear();
    body.extend(Header::kSize);
    Encoder to(body);
    to.put(true);
    to.put(0.5);
    to.put(std::string_view("joint"));
    to.put(position);
  });
  expect_realtime("ride::finish_message", [&] { finish_message(body, 0, {}, Type::kReply, 1); });
  std::vector<double> taken(3);
  std::string name(16, ' ');
  bool all = false;
  expect_realtime("Decoder", [&] {
    Decoder from(body.bytes().subspan(Header::kSize));
    bool on = false;
    double half = 0;
    all = from.take(on) && from.take(half) && from.take(name) && from.take(taken) && from.ended();
  });
  EXPECT_TRUE(all);
  EXPECT_EQ(taken, position);
}

}  // namespace
}  // namespace armature::ride
