// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/orocos/property_file.hpp"

namespace armature::orocos {

using namespace document;
namespace {

std::string messages(const std::string& text) {
  base::Diagnostics diagnostics;
  parse_cpf(text, "motor.cpf", diagnostics);
  return diagnostics.to_text();
}

std::vector<Property> parse(const std::string& elements) {
  base::Diagnostics diagnostics;
  auto properties =
      parse_cpf("<properties>\n" + elements + "</properties>\n", "motor.cpf", diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  return properties;
}

std::string value_of(const std::string& type, const std::string& text) {
  const auto properties =
      parse("<simple name=\"x\" type=\"" + type + "\"><value>" + text + "</value></simple>");
  return to_text(properties.at(0).value);
}

TEST(PropertyFile, HasNamesValuesDescriptionsAndPlaces) {
  const auto properties = parse(
      "  <simple name=\"Kp\" type=\"double\"><description>the gain</description><value>2.5</value>"
      "</simple>\n");
  ASSERT_EQ(properties.size(), 1u);
  EXPECT_EQ(properties[0].name, "Kp");
  EXPECT_EQ(properties[0].value.text, "2.5");
  EXPECT_EQ(properties[0].description, "the gain");
  EXPECT_EQ(properties[0].where, (base::Location{"motor.cpf", 2, 3}));
}

TEST(PropertyFile, EveryTypeOfOrocosIsRead) {
  EXPECT_EQ(value_of("boolean", "1"), "true");
  EXPECT_EQ(value_of("boolean", "false"), "false");
  EXPECT_EQ(value_of("char", "x"), "!char x");
  EXPECT_EQ(value_of("short", "-3"), "!short -3");
  EXPECT_EQ(value_of("ushort", "3"), "!ushort 3");
  EXPECT_EQ(value_of("long", "-123456"), "-123456");
  EXPECT_EQ(value_of("ulong", "4000000000"), "!ulong 4000000000");
  EXPECT_EQ(value_of("longlong", "-9000000000000"), "!longlong -9000000000000");
  EXPECT_EQ(value_of("ullong", "18446744073709551615"), "18446744073709551615");
  EXPECT_EQ(value_of("float", "1e-3"), "!float 1e-3");
  EXPECT_EQ(value_of("double", " 1e-3 "), "1e-3");
  EXPECT_EQ(value_of("double", "10"), "10.0") << "so that it shows what it is";
  EXPECT_EQ(value_of("double", "nan"), "!double nan");
  EXPECT_EQ(value_of("string", " a b "), "\" a b \"");
  EXPECT_EQ(value_of("string", "5"), "!string 5");
  EXPECT_EQ(value_of("string", ""), "\"\"");
}

TEST(PropertyFile, ListsAreArraysOrSequences) {
  const auto properties = parse(
      "<struct name=\"a\" type=\"array\"><simple name=\"Size\" type=\"long\"><value>2</value>"
      "</simple><simple name=\"Element0\" type=\"double\"><value>1</value></simple>"
      "<simple name=\"Element1\" type=\"double\"><value>2.5</value></simple></struct>"
      "<sequence name=\"s\"><simple type=\"long\"><value>1</value></simple></sequence>"
      "<struct name=\"t\" type=\"strings\"><simple type=\"string\"><value>x</value></simple>"
      "</struct>");
  ASSERT_EQ(properties.size(), 3u);
  EXPECT_EQ(to_text(properties[0].value), "[1, 2.5]");
  EXPECT_EQ(to_text(properties[1].value), "[1]");
  EXPECT_EQ(to_text(properties[2].value), "[x]");
}

TEST(PropertyFile, StructsAreMaps) {
  const auto properties = parse(
      "<struct name=\"p\" type=\"PropertyBag\"><description>pose</description>"
      "<simple name=\"x\" type=\"double\"><value>0.5</value></simple></struct>"
      "<struct name=\"f\" type=\"/geometry_msgs/Pose\"/>");
  EXPECT_EQ(to_text(properties.at(0).value), "{x: 0.5}");
  EXPECT_EQ(properties.at(0).description, "pose");
  EXPECT_EQ(to_text(properties.at(1).value), "!orocos:/geometry_msgs/Pose {}");
}

TEST(PropertyFile, IsWrittenAsOrocosReadsIt) {
  const auto properties = parse(
      "<simple name=\"b\" type=\"boolean\"><value>1</value></simple>"
      "<simple name=\"Kp\" type=\"double\"><description>a &lt; b</description><value>2.5</value>"
      "</simple>"
      "<simple name=\"n\" type=\"ushort\"><value>3</value></simple>"
      "<simple name=\"t\" type=\"string\"><value>x &amp; \"y\"&#10;</value></simple>"
      "<struct name=\"v\" type=\"array\"><description>two</description>"
      "<simple type=\"double\"><value>1</value></simple></struct>"
      "<struct name=\"p\"><simple name=\"x\" type=\"double\"><value>0.5</value></simple></struct>");
  EXPECT_EQ(write_cpf(properties), R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE properties SYSTEM "cpf.dtd">
<properties>
  <simple name="b" type="boolean"><value>true</value></simple>
  <simple name="Kp" type="double"><description>a &lt; b</description><value>2.5</value></simple>
  <simple name="n" type="ushort"><value>3</value></simple>
  <simple name="t" type="string"><value>x &amp; &quot;y&quot;&#10;</value></simple>
  <struct name="v" type="array">
    <description>two</description>
    <simple name="Element0" type="double"><value>1</value></simple>
  </struct>
  <struct name="p" type="PropertyBag">
    <simple name="x" type="double"><value>0.5</value></simple>
  </struct>
</properties>
)");
}

TEST(PropertyFile, AListWhoseElementsSayTheirTypesKeepsThem) {
  const auto properties = parse(
      "<sequence name=\"v\"><simple type=\"char\"><value>1</value></simple>"
      "<simple type=\"double\"><value>2</value></simple></sequence>");
  const std::string written = write_cpf(properties);
  EXPECT_NE(written.find(R"(  <sequence name="v">
    <simple name="Element0" type="char"><value>1</value></simple>
    <simple name="Element1" type="double"><value>2.0</value></simple>
  </sequence>
)"),
            std::string::npos)
      << written;
}

TEST(PropertyFile, NamesTheTypeThatAValueIsGiven) {
  Property gain{"Kp", {}, "gain", {}};
  gain.value.kind = Value::Kind::kText;
  gain.value.text = "10";
  gain.value.type = "double";
  EXPECT_NE(write_cpf({gain}).find("<simple name=\"Kp\" type=\"double\"><description>gain"
                                   "</description><value>10</value></simple>"),
            std::string::npos);
}

TEST(PropertyFile, MistakesAreReportedWithTheirPlace) {
  EXPECT_EQ(messages("<properties>\n<simple name=\"x\" type=\"double\"><value>1,5</value></simple>"
                     "\n</properties>"),
            "motor.cpf:2:1: error: simple 'x' of type double must be a number, found '1,5'\n");
  EXPECT_EQ(messages("<properties><simple name=\"x\" type=\"double\"><value>1e999</value></simple>"
                     "</properties>"),
            "motor.cpf:1:13: error: simple 'x' of type double must be a number, found '1e999'\n");
  EXPECT_EQ(messages("<properties><simple name=\"c\" type=\"char\"><value>ab</value></simple>"
                     "</properties>"),
            "motor.cpf:1:13: error: simple 'c' of type char must be one character, found 'ab'\n");
  EXPECT_EQ(messages("<properties><simple type=\"long\"><value>1</value></simple></properties>"),
            "motor.cpf:1:13: error: a property needs a name (add name=\"...\")\n");
  EXPECT_EQ(messages("<properties><simple name=\"x\""),
            "motor.cpf:1:28: error: this is not XML: Error parsing start element tag\n");
  EXPECT_EQ(messages(std::string("<properties>\0</properties>", 26)),
            "motor.cpf:1:13: error: control character 0x00 in a text file\n");
  EXPECT_EQ(messages("<properties>\n\xc3</properties>"),
            "motor.cpf:2:1: error: byte 0xC3 is not valid UTF-8 (save the file as UTF-8)\n");
}

}  // namespace
}  // namespace armature::orocos
