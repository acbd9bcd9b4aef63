// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/component.hpp"

namespace armature::component {

/// The component models that a program can make.
class Registry {
 public:
  using Make = std::unique_ptr<Component> (*)(std::string name);
  struct Model {
    std::string name;
    std::string doc;
    std::string library;  ///< empty for models of the program itself
    Make make;
  };

  /// Adds a model; refused if the name is taken, naming both libraries.
  base::Result<void> add(Model model);

  /// Adds the model `ComponentClass`, whose constructor takes the component's name.
  template <typename ComponentClass>
  void add(std::string_view name, std::string_view doc) {
    problems_.append(add_here(name, doc, [](std::string component_name) {
      return std::unique_ptr<Component>(
          std::make_unique<ComponentClass>(std::move(component_name)));
    }));
  }

  /// The library whose function fills the registry now.
  void begin_library(std::string library) { library_ = std::move(library); }
  /// What went wrong since `begin_library`, empty if nothing.
  std::string end_library();

  const Model* find(std::string_view name) const;
  std::vector<std::string> names() const;

 private:
  std::string add_here(std::string_view name, std::string_view doc, Make make);

  std::map<std::string, Model, std::less<>> models_;
  std::string library_;
  std::string problems_;
};

/// What a component library exports. The host refuses a library whose `abi` is not its own.
struct LibraryDescription {
  const char* abi;
  const char* name;
  void (*fill)(Registry& registry);
};

/// Identifies everything that host and library must agree on: version, compiler's C++ ABI, standard
/// library, and the sizes of the types that both touch.
const char* abi_tag();

/// The ABI of whoever includes this header, compiled into each library.
#define ARMATURE_ABI_TAG                                                        \
  "armature-0.1/" ARMATURE_STRINGIZE(__GXX_ABI_VERSION) "/" ARMATURE_STRINGIZE( \
      _GLIBCXX_USE_CXX11_ABI) "/" ARMATURE_STRINGIZE(__cplusplus)
#define ARMATURE_STRINGIZE(x) ARMATURE_STRINGIZE_(x)
#define ARMATURE_STRINGIZE_(x) #x

inline constexpr const char* kLibraryEntry = "armature_component_library";

/// The one function that a component library exports:
/// `ARMATURE_COMPONENT_LIBRARY(motion, registry) { registry.add<Pid>("PID", "one-joint PID"); }`
#define ARMATURE_COMPONENT_LIBRARY(library_name, registry)                       \
  static void armature_fill_registry(::armature::component::Registry& registry); \
  extern "C" __attribute__((visibility("default")))                              \
  const ::armature::component::LibraryDescription*                               \
  armature_component_library() {                                                 \
    static const ::armature::component::LibraryDescription description{          \
        ARMATURE_ABI_TAG, #library_name, &armature_fill_registry};               \
    return &description;                                                         \
  }                                                                              \
  static void armature_fill_registry(::armature::component::Registry& registry)

}  // namespace armature::component
