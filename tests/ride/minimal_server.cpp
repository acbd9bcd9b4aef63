// SPDX-License-Identifier: Apache-2.0
// One component behind TCP. Prints its address when it is ready; ends with its standard input.
#include <cstdio>

#include "armature/ride/node.hpp"

namespace {

using armature::ride::Decoder;
using armature::ride::Executed;
using armature::ride::Number;
using armature::ride::Reply;

constexpr armature::ride::Declaration kDeclarations[] = {{"int setVelocity(float,float)"}};
constexpr armature::ride::Interface kChassis{"Chassis", kDeclarations};

class Chassis : public armature::ride::Service {
 public:
  Chassis() : Service(kChassis) {}

 private:
  Executed execute(Number operation, Decoder& parameters, Reply& reply) override {
    float left = 0;
    float right = 0;
    if (operation != kDeclarations[0].number()) return Executed::kNoSuchOperation;
    if (!parameters.take(left) || !parameters.take(right) || !parameters.ended()) {
      return Executed::kMalformed;
    }
    reply.put(std::int32_t{0});
    return Executed::kDone;
  }
};

}  // namespace

int main() {
  Chassis chassis;
  armature::ride::Node node;
  const auto address = node.listen("tcp://127.0.0.1:0");
  if (!address || !node.add("chassis", chassis)) return 1;
  std::printf("%s\n", address.value().text().c_str());
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  node.remove(chassis);
}
