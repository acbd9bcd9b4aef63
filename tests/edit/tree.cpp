// SPDX-License-Identifier: Apache-2.0
#include "tests/edit/tree.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "armature/document/yaml.hpp"

namespace armature::edit::tests {
namespace {

namespace fs = std::filesystem;

base::Result<std::string> read_disk(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return base::Error{"file '" + path + "' does not exist"};
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> find_deployments() {
  std::vector<std::string> found;
  for (const char* folder : {"robots", "examples", "tests"}) {
    const fs::path root = (fs::path(SOURCE_FOLDER) / folder).lexically_normal();
    for (const auto& file : fs::recursive_directory_iterator(root)) {
      if (file.path().extension() != ".yaml") continue;
      base::Diagnostics diagnostics;
      deploy::LoadOptions options;
      options.read = read_disk;
      const auto document = deploy::load_document(file.path().string(), options, diagnostics);
      if (diagnostics.ok() && !document.components.empty()) found.push_back(file.path().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

const std::vector<std::string>& Tree::deployments() {
  static const std::vector<std::string> found = find_deployments();
  return found;
}

deploy::FileReader Tree::reader() {
  return [this](const std::string& path) -> base::Result<std::string> {
    const auto found = changed_.find(path);
    return found == changed_.end() ? read_disk(path) : found->second;
  };
}

std::string Tree::text(const std::string& file) { return reader()(file).value(); }

document::Document Tree::load(const std::string& file, const std::vector<std::string>& settings) {
  base::Diagnostics diagnostics;
  deploy::LoadOptions options;
  options.read = reader();
  options.overrides = settings;
  auto document = deploy::load_document(file, options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return document;
}

void Tree::apply(const Outcome& outcome) {
  for (const FileChange& file : outcome.files) changed_[file.file] = file.after;
}

void Tree::undo(const Outcome& outcome) {
  for (const FileChange& file : outcome.files) {
    changed_[file.file] = replaced(text(file.file), file.inverse);
  }
}

std::string yaml(document::Document document) {
  for (auto& component : document.components) {
    std::ranges::sort(component.properties, std::less<>(), &document::Property::name);
  }
  return document::write_yaml(document);
}

std::vector<std::string> files_of(const std::string& deployment) {
  Tree tree;
  base::Diagnostics diagnostics;
  const SourceMap map(deployment, tree.reader(), tree.load(deployment), diagnostics);
  std::vector<std::string> files;
  for (const auto& file : map.files()) files.push_back(file->path());
  std::reverse(files.begin(), files.end());
  return files;
}

std::vector<Entry> entries_of(const SourceMap& map) {
  std::vector<Entry> entries;
  for (const Entry& entry : map.entries()) {
    if (!entry.changes && !entry.names.empty()) entries.push_back(entry);
  }
  return entries;
}

void check_replacements(const Outcome& outcome, Tree& tree) {
  for (const FileChange& file : outcome.files) {
    EXPECT_EQ(file.before, tree.text(file.file));
    EXPECT_NE(file.before, file.after);
    EXPECT_EQ(replaced(file.before, file.replacements), file.after);
    EXPECT_EQ(replaced(file.after, file.inverse), file.before);
    std::size_t end = 0;
    for (const Replacement& one : file.replacements) {
      EXPECT_LE(end, one.begin);
      EXPECT_LE(one.begin, one.end);
      end = one.end;
    }
  }
}

}  // namespace armature::edit::tests
