// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "armature/edit/edit.hpp"
#include "armature/edit/unified_diff.hpp"
#include "tests/fuzz/round_trip.hpp"

namespace {

using namespace armature;

/// An edit that is made must be taken back by its inverse, and leave a deployment that can be read.
void check_edit(const std::string& text, const edit::Edit& edit) {
  const auto read = [&](const std::string& path) -> base::Result<std::string> {
    if (path == "fuzz.yaml") return text;
    return fuzz::options().read(path);
  };
  const edit::Outcome outcome =
      edit::apply_edits("fuzz.yaml", {edit}, read, fuzz::options().limits);
  const std::string what = edit::to_text(edit.change);
  if (!outcome.ok() && !outcome.files.empty()) fuzz::fail(what.c_str(), text, "a refused edit");
  for (const edit::FileChange& file : outcome.files) {
    if (edit::replaced(file.before, file.replacements) != file.after) {
      fuzz::fail(what.c_str(), file.before, file.after);
    }
    if (edit::replaced(file.after, file.inverse) != file.before) {
      fuzz::fail("undo differs", file.before, file.after);
    }
    if (edit::unified_diff(file).empty()) fuzz::fail("no difference", file.before, file.after);
    if (file.file != "fuzz.yaml") continue;
    base::Diagnostics diagnostics;
    deploy::parse_document(file.after, "fuzz.yaml", fuzz::options(), diagnostics);
    if (!diagnostics.ok()) fuzz::fail(what.c_str(), file.before, file.after);
  }
}

}  // namespace

/// The first byte chooses the edit, the rest is the deployment.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  base::Diagnostics diagnostics;
  const document::Document document =
      deploy::parse_document(text, "fuzz.yaml", fuzz::options(), diagnostics);
  if (!diagnostics.ok()) return 0;
  const bool none = document.components.empty();
  const std::string name =
      none ? "A" : document.components[data[0] % document.components.size()].name;
  const bool overrides = data[0] >= 128;
  const edit::Change changes[] = {edit::Set{name + ".N", "1.5"},
                                  edit::Set{name + ".activity", "triggered"},
                                  edit::AddComponent{"New", "Model"},
                                  edit::RemoveComponent{name},
                                  edit::Rename{name, name + "New"},
                                  edit::Connect{name + ".Out", name + ".In"},
                                  edit::AddPeer{name, name},
                                  edit::AddLibrary{"library"},
                                  edit::AddParameter{"parameter", "[1]"},
                                  edit::Unset{name + ".N"}};
  check_edit(text, {changes[data[0] % std::size(changes)], {"part.yaml"}, overrides});
  return 0;
}
