#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/rt/ticks.hpp"
#include "benchmarks/control_cycle/components.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/control_cycle/monolithic.hpp"
using namespace armature;
using namespace armature::benchmarks;
int main(int argc, char** argv) {
  std::vector<int> ns = {2, 7, 64, 256, 1000};
  bool profile = argc > 2;
  if (argc > 1) ns = {std::atoi(argv[1])};
  for (int n : ns) {
    exec::ApplicationOptions o;
    o.simulated = true;
    if (getenv("MEASURE")) o.measure_every = atoi(getenv("MEASURE"));
    exec::Application app(make_cycle(n, one_thread()), o);
    auto d = app.start();
    if (!d.ok()) {
      std::printf("%s\n", d.to_text().c_str());
      return 1;
    }
    MonolithicController mono(n);
    const int batch = std::max(1, 20000 / n);
    std::vector<double> a, b;
    const double tick = platform::tick_period_ns();
    for (int i = 0; i < (profile ? atoi(argv[2]) : 300); ++i) {
      auto t0 = platform::ticks();
      app.run_for(std::chrono::milliseconds(batch));
      auto t1 = platform::ticks();
      if (!profile)
        for (int k = 0; k < batch; ++k) mono.cycle();
      auto t2 = platform::ticks();
      a.push_back(double(t1 - t0) * tick / batch);
      b.push_back(double(t2 - t1) * tick / batch);
    }
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    auto at = [](auto& v, double q) { return v[size_t(q * double(v.size() - 1))]; };
    int differ = 0;
    for (int i = 0; i < n; ++i) {
      auto* c = static_cast<Card*>(app.find("Card" + std::to_string(i + 1)));
      if (std::memcmp(&c->motor(), &mono.motor(i), 24) != 0) ++differ;
    }
    std::printf(
        "N %4d: %9.1f ns (min %9.1f) mono %8.1f (min %8.1f) ratio %.2f (min %.2f) per joint %.1f "
        "differ %d  %.17g\n",
        n, at(a, .5), a[0], at(b, .5), b[0], at(a, .5) / at(b, .5), a[0] / b[0], at(a, .5) / n,
        differ, mono.motor(0).voltage());
  }
}
