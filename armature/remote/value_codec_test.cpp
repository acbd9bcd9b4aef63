// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/value_codec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::remote {
namespace {

struct Pose {
  double x = 0.0;
  std::uint8_t flags = 0;
  std::int64_t stamp = 0;
  friend bool operator==(const Pose&, const Pose&) = default;
};
ARMATURE_STRUCT(Pose, x, flags, stamp);

struct Path {
  bool closed = false;
  std::string name;
  base::FixedText<5> label;
  std::vector<Pose> poses;
  std::array<float, 3> colour{};
  std::vector<std::string> words;
  friend bool operator==(const Path&, const Path&) = default;
};
ARMATURE_STRUCT(Path, closed, name, label, poses, colour, words);

enum class Light : std::uint8_t { kOff, kBlinking = 7 };
ARMATURE_ENUM(Light, kOff, kBlinking);

template <typename T>
ride::Body encoded(const T& value) {
  ride::Body body;
  ride::Encoder to(body);
  encode(to, Outgoing{&types::type_of<T>(), &value});
  return body;
}

template <typename T>
bool decoded(const ride::Body& body, T& value) {
  ride::Decoder from(body.bytes());
  Incoming place{&types::type_of<T>(), &value};
  return decode(from, place) && from.ended();
}

TEST(ValueCodec, NamesTypesAsTheInterfaceLanguageDoes) {
  EXPECT_EQ(canonical(types::type_of<std::uint32_t>()), "unsigned int");
  EXPECT_EQ(canonical(types::type_of<std::int8_t>()), "char");
  EXPECT_EQ(canonical(types::type_of<std::uint8_t>()), "byte");
  EXPECT_EQ(canonical(types::type_of<std::int64_t>()), "long");
  EXPECT_EQ(canonical(types::type_of<base::FixedText<5>>()), "String");
  EXPECT_EQ(canonical(types::type_of<std::vector<double>>()), "Array<double>");
  EXPECT_EQ(canonical(types::type_of<std::array<float, 3>>()), "Array<float,3>");
  EXPECT_EQ(canonical(types::type_of<Path>()),
            "struct Path{bool,String,String,Array<struct Pose{double,byte,long}>,Array<float,3>,"
            "Array<String>}");
}

/// What rcidl's code would send for the same values (docs/ride.md, "Body").
TEST(ValueCodec, SendsTheSameBytesAsGeneratedCode) {
  ride::Body expected;
  ride::Encoder to(expected);
  to.put(true);
  to.put("way");
  to.put("short");
  to.put(std::uint32_t{1});
  to.put(0.5);
  to.put(std::uint8_t{7});
  to.put(std::int64_t{-2});
  to.put(std::array<float, 3>{1.0f, 2.0f, 3.0f});
  to.put(std::vector<std::string>{"a", "bc"});
  const Path path{true, "way", "short", {{0.5, 7, -2}}, {1.0f, 2.0f, 3.0f}, {"a", "bc"}};
  const ride::Body body = encoded(path);
  EXPECT_TRUE(std::ranges::equal(body.bytes(), expected.bytes()));
  Path again;
  ASSERT_TRUE(decoded(body, again));
  EXPECT_EQ(again, path);
}

TEST(ValueCodec, AnEnumerationIsItsIntegerAndOtherNumbersAreRefused) {
  EXPECT_EQ(canonical(types::type_of<Light>()), "enum Light:byte{off=0,blinking=7}");
  const ride::Body body = encoded(Light::kBlinking);
  EXPECT_EQ(body.bytes().size(), 1u);
  Light light = Light::kOff;
  ASSERT_TRUE(decoded(body, light));
  EXPECT_EQ(light, Light::kBlinking);
  EXPECT_FALSE(decoded(encoded(std::uint8_t{1}), light));
}

TEST(ValueCodec, RefusesWhatIsTooShortOrTooLong) {
  const ride::Body whole = encoded(Path{true, "way", "short", {{}, {}}, {}, {"a"}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Path path;
    ride::Decoder from(whole.bytes().first(size));
    Incoming place{&types::type_of<Path>(), &path};
    EXPECT_FALSE(decode(from, place) && from.ended()) << size;
  }
  base::FixedText<5> label;
  EXPECT_FALSE(decoded(encoded(std::string("longer")), label));
}

/// A count that lies is found out before memory is asked for.
TEST(ValueCodec, BelievesNoCountBeyondWhatIsThere) {
  ride::Body body;
  ride::Encoder to(body);
  to.put(std::uint32_t{100});
  for (int i = 0; i < 100; ++i) to.put(std::uint8_t{0});
  std::vector<Pose> poses;
  EXPECT_FALSE(decoded(body, poses));
  EXPECT_TRUE(poses.empty());
}

}  // namespace
}  // namespace armature::remote
