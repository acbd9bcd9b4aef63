// SPDX-License-Identifier: Apache-2.0
#include "armature/types/dds_idl.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::types {
namespace {

enum class Way : std::uint8_t { kLeft, kRight };
ARMATURE_ENUM(Way, kLeft, kRight);

struct Spot {
  double x = 0.0;
  float y = 0.0f;
};
ARMATURE_STRUCT(Spot, (x, "m"), y);

struct Walk {
  Way way = Way::kLeft;
  std::array<Spot, 2> ends{};
  std::vector<Spot> between{};
  base::FixedText<15> name{};
  std::array<std::array<std::int16_t, 3>, 2> matrix{};
};
ARMATURE_STRUCT(Walk, way, ends, between, name, matrix);

TEST(DdsIdl, NamesTypesAsRosDoes) {
  EXPECT_EQ(dds_name(type_of<Walk>()), "armature::msg::dds_::Walk_");
  EXPECT_EQ(dds_name(type_of<double>()), "armature::msg::dds_::Float64_");
  EXPECT_EQ(dds_name(type_of<std::vector<double>>()), "armature::msg::dds_::Float64Vector_");
  EXPECT_EQ(dds_name(type_of<std::array<float, 3>>()), "armature::msg::dds_::Float32Array3_");
}

TEST(DdsIdl, HasInnerStructsFirstAndEachOnce) {
  const std::array<const Type*, 3> types{&type_of<Walk>(), &type_of<Spot>(),
                                         &type_of<std::vector<double>>()};
  EXPECT_EQ(dds_idl(types),
            "module armature { module msg { module dds_ {\n"
            "  struct Spot_ {\n"
            "    double x;  // m\n"
            "    float y;\n"
            "  };\n"
            "  struct Walk_ {\n"
            "    uint8 way;  // left = 0, right = 1\n"
            "    armature::msg::dds_::Spot_ ends[2];\n"
            "    sequence<armature::msg::dds_::Spot_ > between;\n"
            "    string<15> name;\n"
            "    int16 matrix[2][3];\n"
            "  };\n"
            "  struct Float64Vector_ {\n"
            "    sequence<double > data;\n"
            "  };\n"
            "}; }; };\n");
}

TEST(DdsIdl, SaysWhatCannotBeOnDds) {
  EXPECT_EQ(dds_objection(type_of<Walk>()), "");
  EXPECT_EQ(dds_objection(type_of<std::vector<std::array<double, 2>>>()),
            "a vector of arrays is no type of DDS: use a struct with the array in it");
}

}  // namespace
}  // namespace armature::types
