// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/edit.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/edit/internal/workshop.hpp"

namespace armature::edit {
namespace {

using internal::State;
using internal::Workshop;

/// The files of a deployment while they are edited.
class Texts {
 public:
  explicit Texts(deploy::FileReader read) : read_(std::move(read)) {}

  base::Result<std::string> read(const std::string& path) {
    const auto found = files_.find(path);
    if (found != files_.end()) return found->second.after;
    base::Result<std::string> text = read_(path);
    if (text) files_[path] = {path, text.value(), text.value(), {}, {}};
    return text;
  }

  void change(const std::string& path, const std::vector<Replacement>& replacements) {
    FileChange& file = files_.at(path);
    file.replacements = composed(file.before.size(), file.replacements, replacements);
    file.after = replaced(file.before, file.replacements);
  }

  std::vector<FileChange> take_changed() {
    std::vector<FileChange> changed;
    for (auto& [path, file] : files_) {
      if (file.before == file.after) continue;
      file.inverse = inverse_of(file.before, file.replacements);
      changed.push_back(std::move(file));
    }
    return changed;
  }

 private:
  deploy::FileReader read_;
  std::map<std::string, FileChange> files_;
};

bool are_in_order(const std::vector<Replacement>& replacements) {
  std::size_t end = 0;
  return std::all_of(replacements.begin(), replacements.end(), [&](const Replacement& one) {
    return one.begin >= std::exchange(end, one.end) && one.end >= one.begin;
  });
}

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kMost); ++i) {
    text += (i > 0 ? ", " : "") + words[i];
  }
  return words.size() > kMost ? text + " and " + std::to_string(words.size() - kMost) + " more"
                              : text;
}

/// Whether the text that `shop` drafted makes of the document what is meant. Says so if not.
/// @return the deployment after it
State prove(Workshop& shop, Texts& texts) {
  const State& before = shop.before();
  base::Diagnostics found;
  State after = internal::read_state(
      before.file, [&texts](const std::string& path) { return texts.read(path); }, before.limits,
      found);
  if (!found.ok()) {
    shop.refuse("the deployment would have a mistake: " + found.all().front().message,
                found.all().front().hint);
    return after;
  }
  const document::Document expected = shop.expectation()(after, found);
  shop.diagnostics().append(found);
  if (!found.ok()) return after;
  const std::vector<std::string> others = internal::differences(expected, after.document);
  if (!others.empty()) {
    shop.refuse("more than that would change: " + joined(others),
                "a range, a composite, an alias or a parameter may say it for several at once; "
                "name them all, or override it here with --override");
  }
  return after;
}

/// Whether the files that the edit may change are those of the deployment.
bool are_known(const Edit& edit, Workshop& shop) {
  std::vector<std::string> known;
  for (const auto& one : shop.map().files()) known.push_back(one->path());
  for (const std::string& file : edit.files) {
    if (shop.map().file(file) != nullptr) continue;
    shop.refuse("'" + file + "' is no YAML file that the deployment includes",
                base::suggestion(file, known));
  }
  return shop.ok();
}

/// Drafts a change, makes it in `texts`, and proves it. With errors the texts are of no use.
State make(const Edit& edit, const State& before, Texts& texts, base::Diagnostics& diagnostics) {
  base::Diagnostics found;
  Workshop shop(before, edit, found);
  if (are_known(edit, shop)) {
    std::visit([&](const auto& change) { internal::draft(change, shop); }, edit.change);
  }
  State after;
  if (found.ok()) {
    const auto replacements = shop.take();
    const bool possible = std::all_of(replacements.begin(), replacements.end(),
                                      [](const auto& one) { return are_in_order(one.second); });
    if (!possible) shop.refuse("parts of it meet in one place of the text");
    if (possible) {
      for (const auto& [file, changes] : replacements) texts.change(file, changes);
      after = prove(shop, texts);
    }
  }
  diagnostics.append(found);
  return after;
}

}  // namespace

Outcome apply_edits(const std::string& file, const std::vector<Edit>& edits,
                    const deploy::FileReader& read, const document::Limits& limits) {
  Outcome outcome;
  if (is_orocos_file(file)) {
    outcome.diagnostics.error({file, 0, 0}, "OROCOS files are not edited",
                              "armature convert writes it as YAML");
    return outcome;
  }
  Texts texts(read);
  if (const auto text = texts.read(normal_path(file)); !text) {
    outcome.diagnostics.error({}, text.error());
    return outcome;
  }
  State state = internal::read_state(
      file, [&texts](const std::string& path) { return texts.read(path); }, limits,
      outcome.diagnostics);
  if (!outcome.ok()) {
    outcome.diagnostics.error({file, 0, 0}, "a deployment with mistakes is not edited",
                              "mend them in the text first");
    return outcome;
  }
  for (const Edit& edit : edits) {
    state = make(edit, state, texts, outcome.diagnostics);
    if (!outcome.ok()) return outcome;
  }
  outcome.files = texts.take_changed();
  return outcome;
}

}  // namespace armature::edit
