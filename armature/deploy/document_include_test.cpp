// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/deploy/internal/document_in_memory.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using internal::Files;
using internal::load_files;
using internal::Loaded;

TEST(Include, TakesAllSectionsOfTheOtherFile) {
  const Loaded loaded =
      load_files("a.yaml", {{"a.yaml",
                             "include: b.yaml\nlibraries: [x, y]\ncomponents: {A: {model: M}}\n"
                             "connections: [A.Out -> B.In]\n"},
                            {"b.yaml",
                             "application: b\nlibraries: [y, z]\ncomponents: {B: {model: N}}\n"
                             "connections: [B.Out -> A.In]\n"}});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.yaml(),
            "application: b\n"
            "libraries: [y, z, x]\n"
            "components:\n"
            "  B:\n"
            "    model: N\n"
            "    activity: sequential\n"
            "  A:\n"
            "    model: M\n"
            "    activity: sequential\n"
            "connections:\n"
            "  - B.Out -> A.In\n"
            "  - A.Out -> B.In\n");
}

TEST(Include, PathsAreRelativeToTheIncludingFile) {
  const Loaded loaded =
      load_files("robots/head.yaml", {{"robots/head.yaml", "include: [parts/eye.yaml]\n"},
                                      {"robots/parts/eye.yaml", "include: ../lens.yaml\n"},
                                      {"robots/lens.yaml", "application: lens\n"}});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.application, "lens");
}

TEST(Include, OtherPathsAreRelativeToTheFileThatNamesThem) {
  const Loaded loaded = load_files(
      "robots/head.yaml", {{"robots/head.yaml", "include: parts/eye.yaml\nlibraries: [./own.so]\n"},
                           {"robots/parts/eye.yaml",
                            "libraries: [lens, ./eye.so]\n"
                            "components: {E: {model: M, property_file: ../eye.cpf}}\n"}});
  EXPECT_EQ(loaded.messages(), "");
  const Document& document = loaded.document;
  EXPECT_EQ(document.libraries.at(0).name, "lens") << "a name is not a path";
  EXPECT_EQ(document.libraries.at(1).name, "parts/eye.so");
  EXPECT_EQ(document.libraries.at(2).name, "./own.so");
  EXPECT_EQ(document.components.at(0).property_files.at(0).path, "eye.cpf");
  EXPECT_EQ(path_from(document, "parts/eye.cpf"), "robots/parts/eye.cpf");
}

TEST(Include, HereIsTheFolderOfTheFileInWhichItStands) {
  const Loaded loaded = load_files(
      "robots/head.yaml",
      {{"robots/head.yaml",
        "include: parts/eye.yaml\nparameters: {own: \"${here}\"}\n"
        "components: {H: {model: M, properties: {x: \"${own}/a\", y: \"${here}\"}}}\n"},
       {"robots/parts/eye.yaml",
        "parameters: {lens: \"${here}/lens\"}\n"
        "components: {E: {model: M, properties: {x: \"${lens}\", y: \"${here}/e\"}}}\n"}});
  EXPECT_EQ(loaded.messages(), "");
  const auto value = [&](std::size_t component, std::size_t property) {
    return to_text(loaded.document.components.at(component).properties.at(property).value);
  };
  EXPECT_EQ(value(0, 0), "robots/parts/lens");
  EXPECT_EQ(value(0, 1), "robots/parts/e");
  EXPECT_EQ(value(1, 0), "robots/a");
  EXPECT_EQ(value(1, 1), "robots");
}

Loaded with_included_grants(const std::string& own) {
  return load_files("real.yaml",
                    {{"real.yaml", "include: simulated.yaml\n" + own},
                     {"simulated.yaml", "grants: {script: [A.arm], remote: [A.arm, A.move]}\n"}});
}

TEST(Include, OfGrantsTheLastWordCounts) {
  const Loaded loaded = with_included_grants("grants: {script: [B.arm]}\n");
  EXPECT_EQ(loaded.messages(), "");
  ASSERT_EQ(loaded.document.script_grants.size(), 1U);
  EXPECT_EQ(loaded.document.script_grants[0].component, "B");
  EXPECT_EQ(loaded.document.remote_grants.size(), 2U) << "of which nothing was said";
}

TEST(Include, AnEmptyListTakesBackWhatWasGranted) {
  const Loaded scripts = with_included_grants("grants: {script: []}\n");
  EXPECT_EQ(scripts.messages(), "");
  EXPECT_TRUE(scripts.document.script_grants.empty());
  EXPECT_EQ(scripts.document.remote_grants.size(), 2U);
  EXPECT_TRUE(with_included_grants("grants: {remote: []}\n").document.remote_grants.empty());
}

TEST(Include, AnEmptyMapTakesBackAllThatWasGranted) {
  const Loaded loaded = with_included_grants("grants: {}\n");
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_TRUE(loaded.document.script_grants.empty());
  EXPECT_TRUE(loaded.document.remote_grants.empty());
}

TEST(Include, TwoIncludedFilesDoNotContradictEachOtherInGrants) {
  const Loaded loaded = load_files("a.yaml", {{"a.yaml", "include: [b.yaml, c.yaml]\n"},
                                              {"b.yaml", "grants: {script: [A.arm]}\n"},
                                              {"c.yaml", "grants: {script: [A.move]}\n"}});
  EXPECT_NE(loaded.messages().find("'script' is given twice"), std::string::npos);
}

TEST(Include, HereCannotBeDeclared) {
  const Loaded loaded = load_files("a.yaml", {{"a.yaml", "parameters: {here: x}\n"}});
  EXPECT_NE(loaded.messages().find("parameter 'here' is always the file's folder"),
            std::string::npos);
}

TEST(Include, OwnValuesReplaceIncludedOnes) {
  const Loaded loaded =
      load_files("a.yaml", {{"a.yaml", "include: b.yaml\napplication: a\nparameters: {n: 3}\n"},
                            {"b.yaml",
                             "application: b\nparameters: {n: 1, m: 2}\n"
                             "components:\n  J{1..${n}}: {model: M}\n"}});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.application, "a");
  EXPECT_EQ(loaded.document.components.size(), 3u);
}

TEST(Include, ComponentsMayBeOverridden) {
  const Loaded loaded = load_files(
      "a.yaml", {{"a.yaml", "include: b.yaml\ncomponents: {J: {override: true, model: Sim}}\n"},
                 {"b.yaml", "components: {J: {model: M, properties: {x: 1}}}\n"}});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.at(0).model, "Sim");
  EXPECT_EQ(loaded.document.components.at(0).properties.size(), 1u);
}

TEST(Include, ReadsAFileOnceHoweverOftenItIsNamed) {
  const Loaded loaded = load_files("a.yaml", {{"a.yaml", "include: [b.yaml, c.yaml]\n"},
                                              {"b.yaml", "include: d.yaml\n"},
                                              {"c.yaml", "include: ./d.yaml\n"},
                                              {"d.yaml", "components: {D: {model: M}}\n"}});
  EXPECT_EQ(loaded.messages(), "");
  EXPECT_EQ(loaded.document.components.size(), 1u);
}

TEST(Include, MayNameAnOrocosFile) {
  const Loaded loaded = load_files(
      "a.yaml", {{"a.yaml", "include: b.xml\n"},
                 {"b.xml", "<properties><struct name=\"B{1..2}\" type=\"M\"/></properties>"}});
  EXPECT_EQ(loaded.messages(),
            "b.xml:1:13: error: component 'B{1..2}' is not a valid name (a name has letters, "
            "digits, '_' and '-' and begins with a letter)\n")
      << "no ranges in OROCOS files";
}

struct Mistake {
  Files files;
  const char* message;
};

class IncludeMistake : public testing::TestWithParam<Mistake> {};

TEST_P(IncludeMistake, IsReportedWithItsPlace) {
  EXPECT_EQ(load_files("a.yaml", GetParam().files).messages(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Each, IncludeMistake,
    testing::Values(
        Mistake{{}, "error: file 'a.yaml' does not exist\n"},
        Mistake{{{"a.yaml", "include: b.yaml\n"}},
                "a.yaml:1:10: error: file 'b.yaml' does not exist\n"},
        Mistake{{{"a.yaml", "include: b.yaml\n"}, {"b.yaml", "include: a.yaml\n"}},
                "b.yaml:1:10: error: 'a.yaml' includes itself (remove it from include)\n"},
        Mistake{{{"a.yaml", "include: {file: b.yaml}\n"}},
                "a.yaml:1:10: error: include takes the path of a file or a list of them\n"},
        Mistake{{{"a.yaml", "include: b.yaml\ncomponents: {J: {model: M}}\n"},
                 {"b.yaml", "components: {J: {model: M}}\n"}},
                "a.yaml:2:14: error: component 'J' is given twice (first at b.yaml:1:14; write "
                "override: true to change that one, remove: true to leave it out)\n"},
        Mistake{{{"a.yaml", "include: [b.yaml, c.yaml]\n"},
                 {"b.yaml", "parameters: {n: 1}\n"},
                 {"c.yaml", "parameters: {n: 2}\n"}},
                "c.yaml:1:14: error: 'n' is given twice (first at b.yaml:1:14)\n"},
        Mistake{{{"a.yaml", "include: b.yaml\ncomposites: {C: {components: {}}}\n"},
                 {"b.yaml", "composites: {C: {connections: []}}\n"}},
                "a.yaml:2:14: error: 'C' is given twice (first at b.yaml:1:14)\n"},
        Mistake{{{"a.yaml", "include: b.yaml\n"}, {"b.yaml", "componets: {}\n"}},
                "b.yaml:1:1: error: document: unknown key 'componets' (did you mean "
                "'components'?)\n"}));

}  // namespace
}  // namespace armature::deploy
