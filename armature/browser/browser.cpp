// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/browser.hpp"

#include "armature/browser/internal/console.hpp"
#include "armature/browser/internal/local_browsing.hpp"

namespace armature::browser {
namespace {

class StandardBrowser final : public Browser {
 public:
  explicit StandardBrowser(bool simulated) : simulated_(simulated) {}

  exec::RunEnd run(exec::Application& application, base::Duration duration,
                   const platform::StopSignal* stop) override {
    internal::LocalBrowsing local(application, duration, stop, simulated_, console_.surface());
    local.session.keep_up();
    mistakes_ += console_.run(local.browser, local.language.vocabulary().quitting);
    return local.session.end();
  }
  void beside(const std::function<void()>& write) override { console_.beside(write); }
  bool at_terminal() const override { return console_.surface().live(); }
  bool at_end() const override { return console_.at_end(); }
  std::size_t mistakes() const override { return mistakes_; }

 private:
  bool simulated_;
  internal::Console console_;
  std::size_t mistakes_ = 0;
};

}  // namespace

std::unique_ptr<Browser> make_browser(bool simulated) {
  return std::make_unique<StandardBrowser>(simulated);
}

}  // namespace armature::browser
