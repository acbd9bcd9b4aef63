// SPDX-License-Identifier: Apache-2.0
#include "python/native/python_component.hpp"

#include <utility>

#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "armature/component/checking/check_of_threads.hpp"
#include "armature/inspect/view.hpp"
#include "python/native/bindings.hpp"
#include "python/native/hook.hpp"
#include "python/native/hosted_members.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using component::Outcome;

/// What an object in Python has of its component, which may be gone.
class Host {
 public:
  explicit Host(std::shared_ptr<PythonComponent*> component) : component_(std::move(component)) {}

  PythonComponent& component() const {
    if (*component_ == nullptr) throw py::value_error("the application of this component is gone");
    return **component_;
  }

  /// The component for its hooks only: meanwhile nobody else reads or writes what it has.
  PythonComponent& in_its_hook() const {
    if (!in_hook()) {
      throw inspect::Refusal(
          "a component in Python has its properties, ports and log in its hooks only: "
          "elsewhere, as in a thread of its own, keep values in plain attributes");
    }
    return component();
  }

 private:
  std::shared_ptr<PythonComponent*> component_;
};

}  // namespace

PythonComponent::PythonComponent(std::string name, std::shared_ptr<const Model> model)
    : component::Component(std::move(name)),
      model_(std::move(model)),
      self_(std::make_shared<PythonComponent*>(this)) {
  const py::gil_scoped_acquire lock;
  const HookScope scope;
  try {
    for (const Declared& declared : model_->members) {
      members_[declared.name] = make_member(*this, declared);
    }
    object_ = model_->made_by(py::cast(Host(self_)));
  } catch (...) {
    *self_ = nullptr;  // whoever has kept the object keeps no component
    throw;
  }
}

PythonComponent::~PythonComponent() {
  const py::gil_scoped_acquire lock;
  *self_ = nullptr;
  object_ = py::object();
  members_.clear();
  model_.reset();
}

HostedMember& PythonComponent::member(const std::string& name) const { return *members_.at(name); }

double PythonComponent::time_s() const { return base::to_seconds(time().time_since_epoch()); }

double PythonComponent::period_s() const { return base::to_seconds(period()); }

void PythonComponent::log(const std::string& level, const std::string& text) {
  if (level == "error") return log_error("{}", text);
  if (level == "warning") return log_warning("{}", text);
  if (level == "debug") return log_debug("{}", text);
  log_info("{}", text);
}

/// The interpreter waits for its lock, and collects garbage, whenever it likes.
void PythonComponent::on_check(component::Check& check) const {
  const auto* const threads = component::CheckOfThreads::of(check);
  if (threads == nullptr || !threads->is_real_time()) return;
  check.error("it is written in Python, and its thread is a real-time one",
              "give it an activity without a priority, or take the priority from its thread");
}

Outcome PythonComponent::on_configure() {
  if (!is_simulated()) {
    return component::refused("a component in Python runs in simulated time only");
  }
  return ask("configure");
}

Outcome PythonComponent::on_start() { return ask("start"); }
void PythonComponent::on_update() { tell("update"); }
void PythonComponent::on_stop() { tell("stop"); }
void PythonComponent::on_cleanup() { tell("cleanup"); }

Outcome PythonComponent::ask(const char* hook) {
  const py::gil_scoped_acquire lock;
  const HookScope scope;
  try {
    object_.attr(hook)();
    return component::accepted();
  } catch (py::error_already_set& thrown) {
    return component::refused(note(thrown));
  }
}

void PythonComponent::tell(const char* hook) {
  const py::gil_scoped_acquire lock;
  const HookScope scope;
  try {
    object_.attr(hook)();
  } catch (py::error_already_set& thrown) {
    fault(note(thrown));
  }
}

std::string PythonComponent::note(py::error_already_set& thrown) {
  const py::module_ traceback = py::module_::import("traceback");
  const py::list parts =
      traceback.attr("format_exception")(thrown.type(), thrown.value(), thrown.trace());
  for (const py::handle part : parts) {
    for (const py::handle line : part.attr("rstrip")().attr("split")("\n")) {
      log_error("{}", text_from_python(line));
    }
  }
  const py::list last = traceback.attr("format_exception_only")(thrown.type(), thrown.value());
  const std::string reason = text_from_python(last[last.size() - 1].attr("strip")());
  // The user's interrupt is not only the component's: the run ends with it, too.
  if (thrown.matches(PyExc_KeyboardInterrupt)) PyErr_SetInterrupt();
  return reason;
}

void bind_components(py::module_& module) {
  py::class_<Host>(module, "Host")
      .def_property_readonly("name", [](const Host& self) { return self.component().name(); })
      .def_property_readonly("time", [](const Host& self) { return self.in_its_hook().time_s(); })
      .def_property_readonly("period",
                             [](const Host& self) { return self.in_its_hook().period_s(); })
      .def(
          "get",
          [](const Host& self, const std::string& name) {
            return self.in_its_hook().member(name).get();
          },
          py::arg("name"))
      .def(
          "set",
          [](const Host& self, const std::string& name, py::handle value) {
            self.in_its_hook().member(name).set(value);
          },
          py::arg("name"), py::arg("value"))
      .def(
          "log",
          [](const Host& self, const std::string& level, const std::string& text) {
            self.in_its_hook().log(level, text);
          },
          py::arg("level"), py::arg("text"));
  py::class_<Model, std::shared_ptr<Model>>(module, "Model")
      .def(py::init([](std::string name, std::string doc, py::object made_by) {
             return std::make_shared<Model>(
                 Model{std::move(name), std::move(doc), std::move(made_by), {}});
           }),
           py::arg("name"), py::arg("doc"), py::arg("made_by"))
      .def(
          "add_property",
          [](Model& self, std::string name, std::string type, std::string unit, std::string doc,
             py::object initial, std::optional<std::pair<double, double>> range,
             bool changeable_while_running) {
            Declared declared{"property",      std::move(name), std::move(type),
                              std::move(unit), std::move(doc),  std::move(initial)};
            if (range) declared.range = component::Range{range->first, range->second};
            declared.changeable_while_running = changeable_while_running;
            self.members.push_back(std::move(declared));
          },
          py::arg("name"), py::arg("type"), py::arg("unit"), py::arg("doc"), py::arg("initial"),
          py::arg("range"), py::arg("changeable_while_running"))
      .def(
          "add_port",
          [](Model& self, std::string kind, std::string name, std::string type, std::string unit,
             std::string doc, std::size_t size, bool triggers, bool may_stay_open) {
            Declared declared{std::move(kind), std::move(name), std::move(type),
                              std::move(unit), std::move(doc),  py::none()};
            declared.size = size;
            declared.triggers = triggers;
            declared.may_stay_open = may_stay_open;
            self.members.push_back(std::move(declared));
          },
          py::arg("kind"), py::arg("name"), py::arg("type"), py::arg("unit"), py::arg("doc"),
          py::arg("size"), py::arg("triggers"), py::arg("may_stay_open"));
}

}  // namespace armature::python
