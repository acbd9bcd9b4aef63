// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/internal/mujoco_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace armature::sim::internal {
namespace {

/// MuJoCo reads files of its own file system, too: one that is in memory.
class FilesInMemory {
 public:
  FilesInMemory() : files_(std::make_unique<mjVFS>()) { mj_defaultVFS(files_.get()); }
  FilesInMemory(const FilesInMemory&) = delete;
  FilesInMemory& operator=(const FilesInMemory&) = delete;
  ~FilesInMemory() { mj_deleteVFS(files_.get()); }

  void add(const char* name, const std::string& text) {
    mj_makeEmptyFileVFS(files_.get(), name, static_cast<int>(text.size()));
    const int index = mj_findFileVFS(files_.get(), name);
    std::copy(text.begin(), text.end(), static_cast<char*>(files_->filedata[index]));
  }
  const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

/// Without a handler MuJoCo writes warnings to a file, from the thread that steps.
void ignore_warning(const char*) {}

}  // namespace

base::Result<Model> compile(const std::string& text, const std::string& name,
                            std::string_view kind) {
  mju_user_warning = ignore_warning;
  // The name tells MuJoCo nothing: it knows a URDF by its root element.
  constexpr const char* kName = "model.xml";
  if (text.empty()) {
    return base::Error{name + ": the file is empty, expected " + std::string(kind)};
  }
  FilesInMemory files;
  files.add(kName, text);
  std::array<char, 1000> error{};
  Model model(mj_loadXML(kName, files.get(), error.data(), static_cast<int>(error.size())));
  if (model == nullptr) return base::Error{name + ": " + error.data()};
  return model;
}

std::string_view name_of(const mjModel& model, mjtObj kind, int index) {
  const char* const name = mj_id2name(&model, kind, index);
  return name == nullptr ? std::string_view() : name;
}

bool is_sound(const mjModel& model, const mjData& data) {
  const auto warned = [](const mjWarningStat& warning) { return warning.number > 0; };
  const auto wild = [](mjtNum acceleration) { return !(std::abs(acceleration) <= mjMAXVAL); };
  const mjtNum* const accelerations = data.qacc;
  return std::none_of(std::begin(data.warning), std::end(data.warning), warned) &&
         std::none_of(accelerations, accelerations + model.nv, wild);
}

}  // namespace armature::sim::internal
