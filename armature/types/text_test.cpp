// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace armature::types {
namespace {

template <typename T>
std::string text_of(const T& value) {
  return to_text(type_of<T>(), &value);
}

template <typename T>
T read(std::string_view text) {
  T value{};
  const base::Result<void> result = from_text(type_of<T>(), text, &value);
  EXPECT_TRUE(result) << text << ": " << (result ? "" : result.error());
  return value;
}

/// What `from_text` says to text that is no `T`; checks that it leaves the value as it was.
template <typename T>
std::string complaint(std::string_view text, const T& before = {}) {
  T value = before;
  const base::Result<void> result = from_text(type_of<T>(), text, &value);
  EXPECT_EQ(value, before);
  return result ? "none" : result.error();
}

TEST(ToText, IsReadable) {
  EXPECT_EQ(text_of(true), "true");
  EXPECT_EQ(text_of(std::int8_t{-5}), "-5");
  EXPECT_EQ(text_of(std::uint8_t{65}), "65");
  EXPECT_EQ(text_of(0.5), "0.5");
  EXPECT_EQ(text_of(0.1f), "0.1");
  EXPECT_EQ(text_of(std::vector<int>{1, 2}), "[1, 2]");
  EXPECT_EQ(text_of(std::vector<int>{}), "[]");
  EXPECT_EQ(text_of(Pose{1, 2}), "{x: 1, y: 2}");
  EXPECT_EQ(text_of(std::array<Pose, 1>{Pose{1, 2}}), "[{x: 1, y: 2}]");
}

TEST(ToText, QuotesTextOnlyWhereItIsNested) {
  EXPECT_EQ(text_of(std::string("a \"b\"")), "a \"b\"");
  EXPECT_EQ(text_of(base::FixedText<4>("ab")), "ab");
  EXPECT_EQ(text_of(std::vector<std::string>{"a \"b\"", "c\\\n\t\x01"}),
            R"(["a \"b\"", "c\\\n\t\x01"])");
}

TEST(ToText, WritesEveryNotANumberAlike) {
  EXPECT_EQ(text_of(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(text_of(-std::numeric_limits<float>::quiet_NaN()), "nan");
  EXPECT_EQ(text_of(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(FromText, ReadsEveryKindBack) {
  const Everything value = make_everything();
  const std::string text = text_of(value);
  Everything result;
  result.names = {"old", "names", "that", "go"};
  result.q = {9};
  const base::Result<void> done = from_text(type_of<Everything>(), text, &result);
  ASSERT_TRUE(done) << done.error();
  EXPECT_EQ(result, value);
}

TEST(FromText, ReadsEveryFloatingPointNumberBack) {
  for (const double value : {0.1, -0.0, 1e300, 5e-324, 1.7976931348623157e308, 123456789.125,
                             std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(read<double>(text_of(value)), value);
    EXPECT_EQ(std::signbit(read<double>(text_of(value))), std::signbit(value));
  }
  EXPECT_TRUE(std::isnan(read<double>("nan")));
  EXPECT_EQ(read<float>(text_of(std::numeric_limits<float>::max())),
            std::numeric_limits<float>::max());
}

TEST(FromText, TakesTextAtTheTopAsItIs) {
  EXPECT_EQ(read<std::string>(" \"a\" "), " \"a\" ");
  EXPECT_EQ(read<std::string>(""), "");
  EXPECT_EQ(read<base::FixedText<4>>("abcd").view(), "abcd");
}

TEST(FromText, TakesFieldsInAnyOrderAndSpaceAnywhere) {
  EXPECT_EQ(read<Pose>(" { y :2 ,\n x:\t1 } "), (Pose{1, 2}));
  EXPECT_EQ(read<std::vector<int>>(" [ 1 ,2 ] "), (std::vector<int>{1, 2}));
  EXPECT_EQ(read<std::vector<int>>("[ ]"), std::vector<int>{});
  EXPECT_EQ(read<int>(" 7 "), 7);
}

TEST(FromText, AcceptsTheLimitsOfEveryIntegerAndNothingBeyond) {
  EXPECT_EQ(read<std::int8_t>("-128"), -128);
  EXPECT_EQ(complaint<std::int8_t>("-129"), "'-129' is out of the range of int8");
  EXPECT_EQ(read<std::uint8_t>("255"), 255);
  EXPECT_EQ(complaint<std::uint8_t>("256"), "'256' is out of the range of uint8");
  EXPECT_EQ(complaint<std::uint8_t>("-1"), "expected a uint8, found '-1'");
  EXPECT_EQ(complaint<std::int16_t>("32768"), "'32768' is out of the range of int16");
  EXPECT_EQ(complaint<std::uint16_t>("65536"), "'65536' is out of the range of uint16");
  EXPECT_EQ(complaint<std::int32_t>("2147483648"), "'2147483648' is out of the range of int32");
  EXPECT_EQ(complaint<std::uint32_t>("4294967296"), "'4294967296' is out of the range of uint32");
  EXPECT_EQ(complaint<std::int64_t>("9223372036854775808"),
            "'9223372036854775808' is out of the range of int64");
  EXPECT_EQ(complaint<std::uint64_t>("18446744073709551616"),
            "'18446744073709551616' is out of the range of uint64");
}

TEST(FromText, RefusesANumberBeyondItsFloatingPointType) {
  EXPECT_EQ(complaint<double>("1e999"), "'1e999' is out of the range of double");
  EXPECT_EQ(complaint<float>("1e39"), "'1e39' is out of the range of float");
  EXPECT_EQ(complaint<double>("1e-999"), "'1e-999' is out of the range of double");
}

TEST(FromText, RefusesWhatIsNotThatScalar) {
  EXPECT_EQ(complaint<int>("1.5"), "expected an int32, found '1.5'");
  EXPECT_EQ(complaint<int>("0x10"), "expected an int32, found '0x10'");
  EXPECT_EQ(complaint<int>("+1"), "expected an int32, found '+1'");
  EXPECT_EQ(complaint<int>(""), "expected an int32, found nothing");
  EXPECT_EQ(complaint<double>("1,5"), "unexpected ',5' after the value");
  EXPECT_EQ(complaint<double>("fast"), "expected a double, found 'fast'");
  EXPECT_EQ(complaint<double>("[1]"), "expected a double, found '[1]'");
  EXPECT_EQ(complaint<bool>("1"), "expected true or false, found '1'");
  EXPECT_EQ(complaint<bool>("True"), "expected true or false, found 'True'");
}

TEST(FromText, RefusesTrailingText) {
  EXPECT_EQ(complaint<int>("1 2"), "unexpected '2' after the value");
  EXPECT_EQ(complaint<std::vector<int>>("[1] ]"), "unexpected ']' after the value");
  EXPECT_EQ(complaint<Pose>("{x: 1, y: 2}, "), "unexpected ', ' after the value");
}

TEST(FromText, NamesUnknownDuplicateAndMissingFields) {
  EXPECT_EQ(complaint<Pose>("{x: 1, z: 2}", {5, 6}), "Pose has no field 'z' (did you mean 'x'?)");
  EXPECT_EQ(complaint<Pose>("{x: 1, yaw: 2}", {5, 6}), "Pose has no field 'yaw' (known: x, y)");
  EXPECT_EQ(complaint<Pose>("{x: 1, y: 2, x: 3}", {5, 6}), "field 'x' is given twice");
  EXPECT_EQ(complaint<Pose>("{y: 1}", {5, 6}), "field 'x' of Pose is missing");
  EXPECT_EQ(complaint<Pose>("{}", {5, 6}), "field 'x' of Pose is missing");
}

TEST(FromText, NamesThePathOfTheMistake) {
  EXPECT_EQ((complaint<std::vector<Pose>>("[{x: 1, y: 2}, {x: 3, y: fast}]", {{5, 6}})),
            "[1].y: expected a double, found 'fast'");
  EXPECT_EQ((complaint<std::array<std::array<int, 2>, 2>>("[[1, 2], [3]]")),
            "[1]: array<int32,2> has 2 elements, found 1");
}

TEST(FromText, RefusesBrokenStructure) {
  EXPECT_EQ(complaint<std::vector<int>>("1, 2"), "expected '[' of vector<int32>, found '1, 2'");
  EXPECT_EQ(complaint<std::vector<int>>("[1, 2"), "expected ',' or ']', found nothing");
  EXPECT_EQ(complaint<std::vector<int>>("[1 2]"), "expected ',' or ']', found '2]'");
  EXPECT_EQ(complaint<std::vector<int>>("[1,]"), "[1]: expected an int32, found ']'");
  EXPECT_EQ((complaint<std::array<int, 1>>("[1, 2]")), "array<int32,1> has 1 elements, found 2");
  EXPECT_EQ(complaint<Pose>("x: 1"), "expected '{' of Pose, found 'x: 1'");
  EXPECT_EQ(complaint<Pose>("{x 1}"), "expected ':' after 'x', found '1}'");
  EXPECT_EQ(complaint<Pose>("{x: 1"), "expected ',' or '}', found nothing");
  EXPECT_EQ(complaint<Pose>("{x: 1, y: 2,}"), "expected the name of a field of Pose, found '}'");
}

TEST(FromText, RefusesBrokenText) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(complaint<Names>("[a]"), "[0]: expected text in double quotes, found 'a]'");
  EXPECT_EQ(complaint<Names>("[\"a]"), "[0]: text has no closing quote");
  EXPECT_EQ(complaint<Names>(R"(["\q"])"), R"([0]: unknown escape '\q' in text)");
  EXPECT_EQ(complaint<Names>(R"(["\x0g"])"), R"([0]: unknown escape '\x' in text)");
  EXPECT_EQ(complaint<Names>(R"(["\)"), R"([0]: unknown escape '\' in text)");
  EXPECT_EQ((complaint<std::vector<base::FixedText<2>>>(R"(["abc"])")),
            "[0]: text of 3 bytes does not fit into text<2>");
  EXPECT_EQ(complaint<base::FixedText<2>>("abc"), "text of 3 bytes does not fit into text<2>");
}

TEST(FromText, ShortensLongTextInItsComplaint) {
  EXPECT_EQ(complaint<int>(std::string(1000, 'x')),
            "expected an int32, found '" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace armature::types
