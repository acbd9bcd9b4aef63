// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/project.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/document/limits.hpp"
#include "armature/studio/internal/places.hpp"
#include "armature/studio/internal/worded_edit.hpp"

namespace armature::studio::internal {
namespace {

std::string joined(std::string list, const std::string& item, const char* separator) {
  return list.empty() ? item : std::move(list) + separator + item;
}

/// Of places alone, and not of the deployment.
bool is_place(const WordedChange& change) {
  return change.edit == "place" || change.edit == "robot";
}

/// Boxes have the names of entries, so they follow these.
base::Result<void> change_places(Places& places, const WordedChange& change) {
  const auto& words = change.words;
  if (change.edit == "rename" && words.size() == 2) places.rename(words[0], words[1]);
  if (change.edit == "remove" && words.size() == 1) places.remove(words[0]);
  if (change.edit == "dissolve" && words.size() == 1) places.dissolve(words[0]);
  if (change.edit == "group") {
    for (std::size_t i = 1; i < words.size(); ++i)
      places.rename(words[i], words[0] + "." + words[i]);
  }
  if (change.edit == "place") {
    if (words.size() != 3) return base::Error{"the edit 'place' takes a box, x and y"};
    places.set(words[0], std::atof(words[1].c_str()), std::atof(words[2].c_str()));
  }
  if (change.edit == "robot") {
    if (words.size() != 2) return base::Error{"the edit 'robot' takes a component and a port"};
    places.move_by(words[0], words[1]);
  }
  return {};
}

std::string text_of(const WordedChange& change) {
  if (change.edit == "place") return "move " + change.words[0];
  if (change.edit == "robot") return "choose what moves " + change.words[0];
  return edit::to_text(change_of(change.edit, change.words).value());
}

}  // namespace

Project::Project(std::string file, Disk disk) : file_(std::move(file)), disk_(std::move(disk)) {
  load(file_);
  load(places_file());
  find_files();
}

const std::string* Project::text(const std::string& path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second.text;
}

Unsaved Project::unsaved() const {
  Unsaved changed;
  for (const auto& [path, file] : files_) {
    if (file.is_changed()) changed.emplace(path, file);
  }
  return changed;
}

void Project::load(const std::string& path) {
  const auto text = disk_.read(path);
  const std::string content = text ? text.value() : std::string();
  files_.emplace(path, ProjectFile{content, content});
}

deploy::FileReader Project::reader() {
  return [this](const std::string& path) -> base::Result<std::string> {
    if (const std::string* text = this->text(path)) return *text;
    return disk_.read(path);
  };
}

/// Those that the deployment includes now; one that nobody includes any more stays while it is
/// not saved.
void Project::find_files() {
  std::vector<std::string> read{places_file()};
  const auto recorded = [&](const std::string& path) -> base::Result<std::string> {
    read.push_back(path);
    if (this->text(path) == nullptr) {
      const auto text = disk_.read(path);
      if (!text) return text;
      files_.emplace(path, ProjectFile{text.value(), text.value()});
    }
    return *this->text(path);
  };
  base::Diagnostics ignored;
  deploy::load_document(file_, {.read = recorded, .seen = {}, .overrides = {}, .limits = {}},
                        ignored);
  std::erase_if(files_, [&](const auto& file) {
    return file.first != file_ && !file.second.is_changed() &&
           std::ranges::find(read, file.first) == read.end();
  });
}

Project::Delta Project::change_to(const std::string& path, const std::string& text) const {
  const std::string& before = *this->text(path);
  Replacements forward = difference(before, text);
  Replacements back = edit::inverse_of(before, forward);
  return {path, std::move(forward), std::move(back)};
}

std::vector<Project::Delta> Project::backwards(const std::vector<Delta>& files) {
  std::vector<Delta> all;
  for (const Delta& file : files) all.push_back({file.file, file.back, file.forward});
  return all;
}

void Project::apply(const std::vector<Delta>& files) {
  for (const Delta& file : files) {
    std::string& text = files_[file.file].text;
    text = edit::replaced(text, file.forward);
  }
  made_.push_back({++version_, files});
  if (made_.size() > kMostSteps) made_.pop_front();
  find_files();
}

void Project::add_step(std::string text, std::vector<Delta> files) {
  std::erase_if(files, [](const Delta& file) { return file.forward.empty(); });
  if (files.empty()) return;
  apply(files);
  undone_.clear();
  done_.push_back({std::move(text), std::move(files)});
  if (done_.size() > kMostSteps) done_.erase(done_.begin());
}

void Project::replace_text(std::string step, const std::string& path, const std::string& text) {
  add_step(std::move(step), {change_to(path, text)});
}

base::Diagnostics Project::edit(const std::vector<WordedChange>& changes,
                                const std::vector<std::string>& files, bool overrides) {
  base::Diagnostics diagnostics;
  std::vector<edit::Edit> edits;
  std::string text;
  for (const WordedChange& change : changes) {
    if (!is_place(change)) {
      auto made = change_of(change.edit, change.words);
      if (!made) {
        diagnostics.error(base::Location{}, made.error());
        return diagnostics;
      }
      edits.push_back({std::move(made.value()), files, overrides});
    }
  }
  const auto places = placed(changes, diagnostics);
  if (!places) return diagnostics;
  std::vector<Delta> made{places.value()};
  if (!edits.empty()) {
    edit::Outcome outcome = edit::apply_edits(file_, edits, reader());
    diagnostics = std::move(outcome.diagnostics);
    if (!diagnostics.ok()) return diagnostics;
    for (const edit::FileChange& file : outcome.files) {
      made.push_back({file.file, file.replacements, file.inverse});
    }
  }
  for (const WordedChange& change : changes) text = joined(std::move(text), text_of(change), ", ");
  add_step(std::move(text), std::move(made));
  return diagnostics;
}

base::Result<Project::Delta> Project::placed(const std::vector<WordedChange>& changes,
                                             base::Diagnostics& diagnostics) const {
  const std::string& before = *text(places_file());
  auto places = Places::parse(before);
  // A file that is no places' stays as it is until a box is moved.
  const bool moves = std::ranges::any_of(changes, is_place);
  if (!places && !moves) return change_to(places_file(), before);
  base::Result<void> moved = places ? base::Result<void>() : base::Error{places.error()};
  for (const WordedChange& change : changes) {
    if (moved) moved = change_places(places.value(), change);
  }
  if (!moved) {
    diagnostics.error(base::Location{places_file(), 0, 0}, moved.error());
    return base::Error{moved.error()};
  }
  const bool none = before.empty() && places.value().empty();
  return change_to(places_file(), none ? before : places.value().to_text());
}

std::vector<const Project::Delta*> Project::made_since(std::int32_t version,
                                                       const std::string& path) const {
  std::vector<const Delta*> all;
  for (const Made& made : made_) {
    if (made.version <= version) continue;
    for (const Delta& file : made.files) {
      if (file.file == path) all.push_back(&file);
    }
  }
  return all;
}

base::Result<void> Project::write(std::int32_t version, const std::string& path,
                                  const std::string& text) {
  const std::string* const now = this->text(path);
  if (now == nullptr) return base::Error{base::quoted(path) + " is no file of this deployment"};
  const std::size_t most = document::Limits{}.file_bytes;
  if (text.size() > most) {
    return base::Error{base::quoted(path) + " would be larger than " + std::to_string(most) +
                       " bytes"};
  }
  const bool known = version <= version_ && (made_.empty() || version >= made_.front().version - 1);
  if (!known) return base::Error{"the text is too old: take the new one, and change that"};
  const std::vector<const Delta*> since = made_since(version, path);
  std::string base = *now;
  for (auto later = since.rbegin(); later != since.rend(); ++later) {
    base = edit::replaced(base, (*later)->back);
  }
  std::optional<Replacements> mine = difference(base, text);
  for (const Delta* theirs : since) {
    if (mine) mine = rebased(*mine, theirs->forward);
  }
  if (!mine) {
    return base::Error{"others changed the same place of " + base::quoted(path) +
                       " meanwhile: take the new text, and change that"};
  }
  replace_text("type in " + path, path, edit::replaced(*now, *mine));
  return {};
}

base::Result<void> Project::undo() {
  if (done_.empty()) return base::Error{"there is nothing to take back"};
  Step step = std::move(done_.back());
  done_.pop_back();
  apply(backwards(step.files));
  undone_.push_back(std::move(step));
  return {};
}

base::Result<void> Project::redo() {
  if (undone_.empty()) return base::Error{"there is nothing to do again"};
  Step step = std::move(undone_.back());
  undone_.pop_back();
  apply(step.files);
  done_.push_back(std::move(step));
  return {};
}

base::Result<void> Project::save() {
  std::vector<edit::FileChange> changes;
  for (const auto& [path, file] : unsaved()) {
    const auto replacements = difference(file.disk, file.text);
    changes.push_back(
        {path, file.disk, file.text, replacements, edit::inverse_of(file.disk, replacements)});
  }
  if (auto saved = disk_.save(changes); !saved) return saved;
  for (const edit::FileChange& change : changes) files_[change.file].disk = change.after;
  return {};
}

void Project::reload() {
  std::vector<Delta> changes;
  for (auto& [path, file] : files_) {
    const auto now = disk_.read(path);
    if (!now) continue;
    file.disk = now.value();
    changes.push_back(change_to(path, now.value()));
  }
  told_conflicts_.clear();
  add_step("take what the disk has", std::move(changes));
}

/// Makes what others changed on the disk part of the text; false where both changed the same.
bool Project::merge(const std::string& path, const std::string& now) {
  ProjectFile& file = files_[path];
  const auto theirs = rebased(difference(file.disk, now), difference(file.disk, file.text));
  if (!theirs && file.text != now) return false;
  const std::string merged = theirs ? edit::replaced(file.text, *theirs) : now;
  file.disk = now;
  replace_text("take what others changed in " + path, path, merged);
  return true;
}

std::string Project::take_from_disk() {
  std::string notice;
  std::vector<std::string> paths;
  for (const auto& [path, file] : files_) paths.push_back(path);
  for (const std::string& path : paths) {
    const auto now = disk_.read(path);
    if (!now || !files_.contains(path) || now.value() == files_[path].disk) continue;
    if (merge(path, now.value())) {
      notice = joined(std::move(notice), "others changed " + path + ": it is taken over", "; ");
    } else if (std::exchange(told_conflicts_[path], now.value()) != now.value()) {
      notice =
          joined(std::move(notice),
                 "others changed " + path +
                     " where you did, too: it cannot be saved. Reload takes theirs; Undo after "
                     "that is yours again, to be saved",
                 "; ");
    }
  }
  return notice;
}

std::string Project::restore(const Unsaved& unsaved) {
  std::vector<Delta> changes;
  for (const auto& [path, kept] : unsaved) {
    if (!files_.contains(path)) load(path);
    files_[path].disk = kept.disk;
    changes.push_back(change_to(path, kept.text));
  }
  if (changes.empty()) return {};
  add_step("restore what was not saved", std::move(changes));
  return joined("what an earlier studio did not save is here again: Undo takes it away",
                take_from_disk(), "; ");
}

}  // namespace armature::studio::internal
