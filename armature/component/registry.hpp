// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/component.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/component/states/state_machine.hpp"
#include "armature/types/enum.hpp"

namespace armature::component {

/// How large a part of an application a component is (paper 4, section II.A).
enum class Granularity : std::uint8_t {
  kAtomic,       ///< touches hardware: a sensor, a drive, a bus
  kComposite,    ///< is a device of several, behind one interface
  kAlgorithm,    ///< computes only
  kApplication,  ///< gives others their tasks
};
ARMATURE_ENUM(Granularity, kAtomic, kComposite, kAlgorithm, kApplication);

/// Option of a model: how the studio draws it, e.g. `drawn_as("slider")`; docs/controls.md lists
/// the faces.
struct Face {
  std::string_view name;
};
inline constexpr Face drawn_as(std::string_view name) { return {name}; }

/// The component models that a program can make.
class Registry {
 public:
  using Make = std::unique_ptr<Component> (*)(std::string name);
  /// A further name of a model. One `#` in it stands for a number, which is the value of a
  /// property: with {"Sensor#Mux", "joints"} the name `Sensor2Mux` is the model with two joints.
  struct FurtherName {
    std::string name;
    std::string property = {};  ///< whose value the number is; empty where there is no `#`
  };
  /// A model of components: its name and how an instance is made.
  struct Model {
    std::string name;
    std::string doc;
    std::string library;  ///< empty for models of the program itself
    Make make;
    std::vector<FurtherName> further_names = {};
    Granularity granularity = Granularity::kAlgorithm;
    std::string face = {};  ///< empty: drawn as a box with its ports

    void apply(Granularity option) { granularity = option; }
    void apply(Face option) { face = option.name; }
  };
  /// A property and the value that a name of a model gives it.
  struct NumberInName {
    std::string property;
    std::string value;
  };

  /// Adds a model; refused if one of its names is taken, naming both libraries.
  base::Result<void> add(Model model);

  /// Adds the model `ComponentClass`, whose constructor takes the component's name. Options: a
  /// `Granularity`, which is an algorithm's unless said otherwise; `drawn_as(face)`.
  template <typename ComponentClass, typename... Options>
  void add(std::string_view name, std::string_view doc, std::vector<FurtherName> further_names,
           Options... options) {
    const Make make = [](std::string component_name) {
      return std::unique_ptr<Component>(
          std::make_unique<ComponentClass>(std::move(component_name)));
    };
    Model model{std::string(name), std::string(doc), library_, make, std::move(further_names)};
    (model.apply(options), ...);
    problems_.append(add_here(std::move(model)));
  }
  template <typename ComponentClass, typename... Options>
  void add(std::string_view name, std::string_view doc, Options... options) {
    add<ComponentClass>(name, doc, std::vector<FurtherName>{}, options...);
  }

  /// The library whose function fills the registry now.
  void begin_library(std::string library) { library_ = std::move(library); }
  /// What went wrong since `begin_library`, empty if nothing.
  std::string end_library();

  /// By its name or a further one; nullptr if there is none.
  const Model* find(std::string_view name) const;
  /// What a name such as `Sensor2Mux` says of a property; nothing if it has no number.
  std::optional<NumberInName> number_in(std::string_view name) const;
  /// Of all models, without further ones.
  std::vector<std::string> names() const;

 private:
  struct Further {
    const Model* model;
    const FurtherName* name;
    std::string number;
  };

  std::string add_here(Model model);
  std::optional<Further> find_further(std::string_view name) const;

  std::map<std::string, Model, std::less<>> models_;
  std::string library_;
  std::string problems_;
};

/// What a component library exports. The host refuses a library whose `abi` or `layout` is not its
/// own, and reads nothing after the one that differs.
struct LibraryDescription {
  const char* abi;
  std::uint64_t layout;
  const char* name;
  void (*fill)(Registry& registry);
};

/// Identifies what host and library must agree on: version, compiler's C++ ABI, standard library.
const char* abi_tag();

/// The `layout_fingerprint()` of the headers that the runtime was built with.
std::uint64_t runtime_layout();

/// The ABI of whoever includes this header, compiled into each library.
#define ARMATURE_ABI_TAG                                                        \
  "armature-0.1/" ARMATURE_STRINGIZE(__GXX_ABI_VERSION) "/" ARMATURE_STRINGIZE( \
      _GLIBCXX_USE_CXX11_ABI) "/" ARMATURE_STRINGIZE(__cplusplus)
#define ARMATURE_STRINGIZE(x) ARMATURE_STRINGIZE_(x)
#define ARMATURE_STRINGIZE_(x) #x

namespace internal {

/// 64-bit FNV-1a of numbers.
constexpr std::uint64_t hash_of(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::uint64_t number : numbers) {
    hash ^= number;
    hash *= 0x00000100000001b3u;
  }
  return hash;
}

/// Differs if the size or alignment of any of the types does.
template <typename... Types>
constexpr std::uint64_t layout_of() {
  return hash_of({hash_of({sizeof(Types), alignof(Types)})...});
}

}  // namespace internal

/// A number that changes with the sizes of the types that host and library share: a library that
/// was compiled against other headers of the same version has another one.
consteval std::uint64_t layout_fingerprint() {
  return internal::hash_of(
      {__GXX_ABI_VERSION, _GLIBCXX_USE_CXX11_ABI,
       internal::layout_of<Component, ExecutionContext, Interface, Outcome, Registry,
                           Registry::Model, StateMachine, Property<double>, Property<std::string>,
                           InputPort<double>, OutputPort<double>, ConnectionPolicy, Event<>,
                           EventHandler<>, Operation<void()>, OperationCaller<void()>, Command<>,
                           CommandCaller<>, types::Type, std::string, std::vector<double>>()});
}

inline constexpr const char* kLibraryEntry = "armature_component_library";

/// The one function that a component library exports:
/// `ARMATURE_COMPONENT_LIBRARY(motion, registry) { registry.add<Pid>("PID", "one-joint PID"); }`
#define ARMATURE_COMPONENT_LIBRARY(library_name, registry)                            \
  static void armature_fill_registry(::armature::component::Registry& registry);      \
  extern "C" __attribute__((visibility("default")))                                   \
  const ::armature::component::LibraryDescription*                                    \
  armature_component_library() {                                                      \
    static const ::armature::component::LibraryDescription description{               \
        ARMATURE_ABI_TAG, ::armature::component::layout_fingerprint(), #library_name, \
        &armature_fill_registry};                                                     \
    return &description;                                                              \
  }                                                                                   \
  static void armature_fill_registry(::armature::component::Registry& registry)

}  // namespace armature::component
