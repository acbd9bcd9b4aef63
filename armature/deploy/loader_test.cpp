// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/loader.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::deploy {

using namespace document;
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

std::string library(const std::string& name) {
  return std::string(TEST_LIBRARIES) + "/lib" + name + ".so";
}

std::string why_not(const std::string& name) {
  component::Registry registry;
  const base::Result<void> loaded = load_library(library(name), registry);
  return loaded ? "it was loaded" : loaded.error();
}

TEST(Loader, AComponentLibraryBringsItsModels) {
  component::Registry registry;
  const base::Result<void> loaded = load_library(library("good"), registry);
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  ASSERT_NE(registry.find("Thing"), nullptr);
  EXPECT_EQ(registry.find("Thing")->library, "good");
  EXPECT_EQ(registry.find("Thing")->make("A")->name(), "A");
}

TEST(Loader, AnotherAbiIsRefusedNamingBothBeforeAnythingElseIsTouched) {
  EXPECT_THAT(why_not("wrong_abi"),
              AllOf(HasSubstr("libwrong_abi.so' was built for armature-9.9/0/0/0"),
                    HasSubstr("but this program is " + std::string(component::abi_tag())),
                    HasSubstr("rebuild the library")));
}

TEST(Loader, AnotherLayoutIsRefusedBeforeTheLibraryIsAskedForItsModels) {
  for (const char* name : {"other_layout", "old_description"}) {
    EXPECT_EQ(why_not(name), "'" + library(name) +
                                 "' was built with other headers of armature-0.1 than this "
                                 "program, so they disagree about the layout of components: "
                                 "rebuild the library with the headers of this program");
  }
}

/// The folders from which the process has loaded files of this name.
std::set<std::string> folders_of_loaded(const std::string& file) {
  std::set<std::string> folders;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const fs::path path = line.substr(std::min(line.find('/'), line.size()));
    if (path.filename().string().starts_with(file)) folders.insert(path.parent_path().string());
  }
  return folders;
}

TEST(Loader, ALibraryBuiltAgainstAnotherInstallationRunsOnTheRuntimeOfThisProgram) {
  ASSERT_THAT(folders_of_loaded("libarmature_can.so"), IsEmpty());
  component::Registry registry;
  const base::Result<void> loaded = load_library(library("built_elsewhere"), registry);
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  EXPECT_NE(registry.find("Sender"), nullptr);
  EXPECT_EQ(folders_of_loaded("libarmature_can.so"), folders_of_loaded("libarmature_component.so"));
}

TEST(Loader, ALibraryOfAnotherVersionIsRefusedBeforeItsRuntimeIsLoaded) {
  const std::set<std::string> own = folders_of_loaded("libarmature_component.so");
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(why_not("other_version"),
            "'" + library("other_version") +
                "' was built for libarmature_component.so.9.9, but this program has "
                "libarmature_component.so.0.1 in '" +
                *own.begin() + "': rebuild the library with this program's headers and compiler");
  EXPECT_EQ(folders_of_loaded("libarmature_component.so"), own);
}

TEST(Loader, ALibraryThatCallsWhatThisRuntimeDoesNotHaveIsToBeRebuilt) {
  EXPECT_THAT(why_not("newer_headers"),
              AllOf(HasSubstr("undefined symbol"), HasSubstr("function_of_tomorrow"),
                    HasSubstr("rebuild the library with the headers of this program")));
}

TEST(Loader, ALibraryWithoutTheFunctionIsNoComponentLibrary) {
  EXPECT_THAT(why_not("no_entry"), AllOf(HasSubstr("libno_entry.so' is not a component library"),
                                         HasSubstr("armature_component_library"),
                                         HasSubstr("write ARMATURE_COMPONENT_LIBRARY")));
}

TEST(Loader, ALibraryWithoutADescriptionIsRefused) {
  EXPECT_THAT(why_not("no_description"), HasSubstr("has an empty library description"));
}

TEST(Loader, AnExceptionOutOfALibraryIsReported) {
  EXPECT_THAT(why_not("throwing"), HasSubstr("threw while it was loaded: no licence"));
}

TEST(Loader, AFileThatIsNoLibraryIsRefusedWithTheLoadersReason) {
  component::Registry registry;
  EXPECT_THAT(load_library("/etc/passwd", registry).error(),
              AllOf(HasSubstr("cannot load the library"), HasSubstr("invalid ELF header")));
}

TEST(Loader, AModelThatExistsAlreadyIsRefusedNamingBothLibraries) {
  component::Registry registry;
  ASSERT_TRUE(load_library(library("good"), registry).ok());
  const base::Result<void> loaded = load_library(library("duplicate"), registry);
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.error(),
              AllOf(HasSubstr("model 'Thing' of library 'duplicate' exists already"),
                    HasSubstr("in library 'good'")));
}

/// An empty folder that goes with the test.
class Folder {
 public:
  Folder() : path_(fs::path(::testing::TempDir()) / "armature_loader_test") {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  std::string add(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name) << content;
    return (path_ / name).string();
  }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

TEST(FindLibrary, TheFirstFolderThatHasItWins) {
  const Folder folder;
  const std::string own = folder.add("libgood.so", "");
  EXPECT_EQ(find_library("good", {"/nowhere", folder.path(), TEST_LIBRARIES}).value(), own);
  EXPECT_EQ(find_library("good", {TEST_LIBRARIES, folder.path()}).value(), library("good"));
}

TEST(FindLibrary, ANameWithASlashIsAFileBesideTheDeployment) {
  const Folder folder;
  const std::string file = folder.add("mine.so", "");
  EXPECT_EQ(find_library(file, {TEST_LIBRARIES}).value(), file);
  EXPECT_EQ(find_library("./mine.so", {TEST_LIBRARIES, folder.path()}).value(),
            folder.path() + "/mine.so");
  EXPECT_EQ(
      find_library("build/mine.so", {TEST_LIBRARIES, folder.path()}).error(),
      "component library 'build/mine.so' was not found: no '" + folder.path() + "/build/mine.so'");
}

TEST(FindLibrary, AMissingOneListsWhereItWasLookedForAndTheNearestName) {
  const Folder folder;
  EXPECT_EQ(find_library("godo", {folder.path(), TEST_LIBRARIES}).error(),
            "component library 'godo' was not found: no libgodo.so in " + folder.path() + ", " +
                TEST_LIBRARIES + "; did you mean 'good'?");
}

TEST(FindLibrary, WithoutANearNameTheHintSaysHowFoldersAreNamed) {
  const Folder folder;
  EXPECT_EQ(find_library("elsewhere", {folder.path()}).error(),
            "component library 'elsewhere' was not found: no libelsewhere.so in " + folder.path() +
                "; build it, or name its folder with -L or ARMATURE_LIBRARY_PATH");
}

TEST(FindLibrary, FoldersComeFromCallerEnvironmentProgramAndDocument) {
  ::setenv("ARMATURE_LIBRARY_PATH", "/a::/b", 1);
  const std::vector<std::string> folders = library_folders({"/first"}, "robots/janus.yaml");
  ::unsetenv("ARMATURE_LIBRARY_PATH");
  ASSERT_EQ(folders.size(), 5u);
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path beside = program.parent_path().parent_path() / "lib" / "armature";
  EXPECT_THAT(folders, ElementsAre("/first", "/a", "/b", beside.string(), "robots"));
  EXPECT_EQ(library_folders({}, "janus.yaml").back(), ".");
}

TEST(FindLibrary, TheAvailableOnesAreListed) {
  const Folder folder;
  folder.add("libmotion.so", "");
  folder.add("motion.txt", "");
  folder.add("lib.so", "");
  EXPECT_THAT(available_libraries({folder.path(), "/nowhere"}), ElementsAre("motion"));
}

TEST(LoadLibraries, EachThatFailsIsReportedAtItsPlaceAndTheOthersAreLoaded) {
  component::Registry registry;
  base::Diagnostics diagnostics;
  const base::Location first{"a.yaml", 2, 13};
  const base::Location last{"a.yaml", 2, 30};
  EXPECT_FALSE(load_libraries({{"godo", first}, {"good", {}}, {"no_entry", last}}, {TEST_LIBRARIES},
                              registry, diagnostics));
  EXPECT_NE(registry.find("Thing"), nullptr);
  ASSERT_EQ(diagnostics.all().size(), 2u) << diagnostics.to_text();
  EXPECT_EQ(diagnostics.all()[0].where, first);
  EXPECT_EQ(diagnostics.all()[1].where, last);
}

TEST(LoadLibraries, OneThatIsNamedTwiceIsLoadedOnce) {
  component::Registry registry;
  base::Diagnostics diagnostics;
  EXPECT_TRUE(load_libraries({{"good", {}}, {library("good"), {}}}, {TEST_LIBRARIES}, registry,
                             diagnostics));
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
}

}  // namespace
}  // namespace armature::deploy
