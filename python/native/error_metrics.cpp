// SPDX-License-Identifier: Apache-2.0
// How well joints follow their references: control::ErrorMetrics, for whoever measures in Python.
#include "armature/control/error_metrics.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "python/native/bindings.hpp"

namespace py = pybind11;

namespace armature::python {
namespace {

using control::ErrorMetrics;

ErrorMetrics make_error_metrics(std::size_t joints, double period_s) {
  if (!std::isfinite(period_s) || std::abs(period_s) > 1e9) {
    throw py::value_error("the period must be a time in seconds, found " +
                          std::to_string(period_s));
  }
  auto made = ErrorMetrics::make({.joints = joints, .period = base::from_seconds(period_s)});
  if (!made) throw py::value_error(made.error());
  return std::move(made).value();
}

void step(ErrorMetrics& metrics, const std::vector<double>& errors) {
  if (metrics.step(errors)) return;
  throw py::value_error("the errors must be one for each of " + std::to_string(metrics.joints()) +
                        " joints, found " + std::to_string(errors.size()));
}

std::vector<ErrorMetrics::Figures> figures_of(const ErrorMetrics& metrics) {
  std::vector<ErrorMetrics::Figures> figures;
  for (std::size_t joint = 0; joint < metrics.joints(); ++joint) {
    figures.push_back(metrics.of(joint));
  }
  return figures;
}

void bind_figures(py::class_<ErrorMetrics>& metrics) {
  using Figures = ErrorMetrics::Figures;
  py::class_<Figures>(metrics, "Figures", "Of one joint; the unit of its error is taken as rad.")
      .def_readonly("iae", &Figures::iae, "integral of |e| [rad s]")
      .def_readonly("itae", &Figures::itae, "integral of t |e| [rad s^2]")
      .def_readonly("ise", &Figures::ise, "integral of e^2 [rad^2 s]")
      .def_readonly("itse", &Figures::itse, "integral of t e^2 [rad^2 s^2]")
      .def_readonly("largest", &Figures::largest, "the largest |e| [rad]")
      .def_readonly("last", &Figures::last, "e of the last sample [rad]")
      .def_readonly("not_finite", &Figures::not_finite,
                    "samples that were left out: the one before stands for them");
}

}  // namespace

void bind_error_metrics(py::module_& module) {
  py::class_<ErrorMetrics> metrics(
      module, "ErrorMetrics",
      "How well joints follow their references: integrals over the error e(t) from the first\n"
      "sample, t = 0, to the last, by the trapezoidal rule (paper 2, table 2).");
  bind_figures(metrics);
  metrics
      .def(py::init(&make_error_metrics), py::arg("joints"), py::arg("period"),
           "period: between two samples [s]. Raises ValueError.")
      .def("step", &step, py::arg("errors"),
           "Adds one sample: reference - measured of each joint. Raises ValueError.")
      .def_property_readonly("joints", &figures_of, "Figures of each joint.")
      .def_property_readonly("samples", &ErrorMetrics::samples);
}

}  // namespace armature::python
