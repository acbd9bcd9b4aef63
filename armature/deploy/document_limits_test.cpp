// SPDX-License-Identifier: Apache-2.0
// Small files that would cost much memory, time or stack are refused.
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"
#include "armature/orocos/property_file.hpp"

namespace armature::deploy {

using namespace orocos;

using namespace document;
namespace {

std::string messages(const std::string& text, const Limits& limits, const char* name = "a.yaml") {
  base::Diagnostics diagnostics;
  LoadOptions options;
  options.limits = limits;
  parse_document(text, name, options, diagnostics);
  return diagnostics.to_text();
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

/// Ten lists of ten aliases each: 10^10 values.
std::string alias_bomb() {
  std::string text = "l0: &l0 [x]\n";
  for (int i = 1; i <= 10; ++i) {
    const std::string before = "*l" + std::to_string(i - 1);
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " [" + before;
    text += repeated(", " + before, 9) + "]\n";
  }
  return text;
}

TEST(Limits, FileSizeIsLimited) {
  Limits limits;
  limits.file_bytes = 10;
  EXPECT_EQ(messages("application: long\n", limits),
            "a.yaml: error: the file has 18 bytes; at most 10 are read\n");
  EXPECT_EQ(messages("<properties/>  ", limits, "a.xml"),
            "a.xml: error: the file has 15 bytes; at most 10 are read\n");
}

TEST(Limits, AliasBombIsRefused) {
  Limits limits;
  limits.nodes = 100'000;
  EXPECT_EQ(messages(alias_bomb(), limits),
            "a.yaml:5:5: error: the document has more than 100000 values\n");
}

TEST(Limits, ParameterBombIsRefused) {
  std::string text = "parameters:\n  p0: xxxxxxxxxx\n";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = "${p" + std::to_string(i - 1) + "}";
    text += "  p" + std::to_string(i) + ": " + before + before + "\n";
  }
  EXPECT_EQ(messages(text, {}),
            "a.yaml:19:8: error: the text becomes longer than a million characters\n");
}

TEST(Limits, NestedRangesAreRefused) {
  Limits limits;
  limits.expanded_nodes = 100'000;
  EXPECT_EQ(messages("components:\n"
                     "  A{1..1000}: {model: M, peers: [\"B{1..1000}\"]}\n",
                     limits),
            "a.yaml:2:34: error: ranges, parameters and composites expand to too many values (make "
            "the ranges smaller)\n");
}

TEST(Limits, CompositesInCompositesAreRefused) {
  std::string text = "components: {a: {model: C20}}\ncomposites:\n  C0: {}\n";
  for (int i = 1; i <= 20; ++i) {
    const std::string before = "{model: C" + std::to_string(i - 1) + "}";
    text += "  C" + std::to_string(i) + ": {components: {\"p{1..9}\": " + before + "}}\n";
  }
  Limits limits;
  limits.expanded_nodes = 100'000;
  const std::string found = messages(text, limits);
  EXPECT_NE(found.find("expand to too many values"), std::string::npos) << found;
}

TEST(Limits, ComponentsOfCompositesAreCountedBeforeTheyAreMade) {
  std::string text = "components: {\"a{1..10}\": {model: C9}}\ncomposites:\n  C0: {}\n";
  for (int i = 1; i <= 9; ++i) {
    const std::string before = "{model: C" + std::to_string(i - 1) + "}";
    text += "  C" + std::to_string(i) + ": {components: {\"p{1..10}\": " + before + "}}\n";
  }
  base::Diagnostics diagnostics;
  const Document document = parse_document(text, "a.yaml", {}, diagnostics);
  EXPECT_EQ(diagnostics.to_text(),
            "a.yaml:4:21: error: 'p{1..10}' brings the deployment to more than 200000 components "
            "and connections (nested composites multiply: make their ranges smaller)\n");
  EXPECT_TRUE(document.components.empty()) << "nothing is built of it";
  EXPECT_TRUE(document.composites.empty());
}

TEST(Limits, ConnectionsOfCompositesAreCountedToo) {
  Limits limits;
  limits.expanded_entries = 100;
  EXPECT_EQ(messages("components: {A: {model: M}}\n"
                     "connections: [\"A.Out{1..60} -> A.In{i}\", \"A.Out{1..60} -> A.On{i}\"]\n",
                     limits),
            "a.yaml:2:42: error: this connection brings the deployment to more than 100 components "
            "and connections (nested composites multiply: make their ranges smaller)\n");
}

TEST(Limits, NamesThatAreRepeatedWithoutEndAreToldAHundredTimes) {
  const std::string one = "<simple name=\"x\" type=\"long\"><value>1</value></simple>\n";
  base::Diagnostics diagnostics;
  parse_cpf("<properties>" + repeated(one, 20'000) + "</properties>", "a.cpf", diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 19'999u);
  EXPECT_EQ(diagnostics.all().size(), base::Diagnostics::kMostOfAKind);
  EXPECT_LT(diagnostics.to_text().size(), 10'000u);
}

TEST(Limits, ComponentsThatAreRepeatedWithoutEndAreToldAHundredTimes) {
  base::Diagnostics diagnostics;
  const Document document = parse_document(
      "<properties>" + repeated("<struct name=\"x\" type=\"M\"/>\n", 20'000) + "</properties>",
      "a.xml", {}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 19'999u);
  EXPECT_EQ(diagnostics.all().size(), base::Diagnostics::kMostOfAKind);
  EXPECT_EQ(document.components.size(), 1u);
}

TEST(Limits, ComponentsOfOneXmlFileAreCounted) {
  Limits limits;
  limits.expanded_entries = 2;
  EXPECT_EQ(messages("<properties><struct name=\"a\" type=\"M\"/><struct name=\"b\" type=\"M\"/>\n"
                     "<struct name=\"c\" type=\"M\"/><struct name=\"d\" type=\"M\"/></properties>",
                     limits, "a.xml"),
            "a.xml:2:1: error: the file has more than 2 components\n");
}

TEST(Limits, DepthOfYamlIsLimited) {
  EXPECT_EQ(messages("a: " + repeated("[", 70) + repeated("]", 70), {}),
            "a.yaml:1:67: error: lists and maps are nested more than 64 deep\n");
  EXPECT_NE(messages(repeated("[", 100'000), {}), "");
  EXPECT_NE(messages(repeated("{a: ", 100'000), {}), "");
  EXPECT_NE(messages(repeated("- ", 100'000), {}), "");
}

TEST(Limits, DepthThroughAliasesIsLimited) {
  std::string text = "l0: &l0 [x]\n";
  for (int i = 1; i <= 100; ++i) {
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i);
    text += " [*l" + std::to_string(i - 1) + "]\n";
  }
  EXPECT_EQ(messages(text, {}),
            "a.yaml:63:12: error: lists and maps are nested more than 64 deep\n");
}

TEST(Limits, DepthOfXmlIsLimited) {
  const std::string text = "<properties>" + repeated("<struct name=\"a\" type=\"M\">", 100'000);
  EXPECT_EQ(messages(text + repeated("</struct>", 100'000) + "</properties>", {}, "a.xml"),
            "a.xml:1:1651: error: elements are nested more than 64 deep\n");
}

TEST(Limits, NumberOfXmlElementsIsLimited) {
  Limits limits;
  limits.nodes = 100;
  const std::string import = "<simple name=\"Import\" type=\"string\"><value>x</value></simple>";
  EXPECT_EQ(messages("<properties>" + repeated(import, 200) + "</properties>", limits, "a.xml"),
            "a.xml:1:6052: error: the file has more than 100 elements\n");
}

TEST(Limits, EntityBombIsRefused) {
  EXPECT_EQ(messages("<!DOCTYPE properties [<!ENTITY a \"xxxxxxxxxx\"><!ENTITY b \"&a;&a;\">]>\n"
                     "<properties armature:application=\"a&b;\"/>\n",
                     {}, "a.xml"),
            "a.xml:1:11: error: declarations in the document type are not read (write only "
            "<!DOCTYPE properties SYSTEM \"cpf.dtd\">)\n");
}

TEST(Limits, NumberOfIncludedFilesIsLimited) {
  Limits limits;
  limits.includes = 3;
  LoadOptions options;
  options.limits = limits;
  options.read = [](const std::string& path) -> base::Result<std::string> {
    return "include: " + path + "x\n";
  };
  base::Diagnostics diagnostics;
  load_document("a", options, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "axx:1:10: error: more than 3 files are included\n");
}

TEST(Limits, LongChainsOfParametersAreRefused) {
  std::string text = "parameters:\n  p0: x\n";
  for (int i = 1; i <= 200; ++i) {
    text.insert(text.find("  p"),
                "  p" + std::to_string(i) + ": ${p" + std::to_string(i - 1) + "}\n");
  }
  const std::string found = messages(text, {});
  EXPECT_NE(found.find("refers to others in too long a chain"), std::string::npos) << found;
}

TEST(Limits, TenThousandComponentsAreFarWithinThem) {
  base::Diagnostics diagnostics;
  const Document document = parse_document(
      "components:\n"
      "  J{1..10000}: {model: M, peers: [\"a{i}\"], properties: {a: 1, b: 2, c: \"{i}\"}}\n"
      "connections:\n  - J{i}.Out -> J{i+1}.In\n",
      "a.yaml", {}, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(document.components.size(), 10'000u);
  EXPECT_EQ(document.connections.size(), 9'999u);
}

}  // namespace
}  // namespace armature::deploy
