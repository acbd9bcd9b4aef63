// SPDX-License-Identifier: Apache-2.0
#include "armature/types/type.hpp"

#include <gtest/gtest.h>

#include "armature/base/hash.hpp"
#include "armature/testing/test_types.hpp"

namespace robot {

struct Wide {
  int a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19, a20;
  int a21, a22, a23, a24, a25, a26, a27, a28, a29, a30;
};
ARMATURE_STRUCT(Wide, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17,
                a18, a19, a20, a21, a22, a23, a24, a25, a26, a27, a28, a29, a30);

struct Reversed {
  int first;
  double second;
};
ARMATURE_STRUCT(Reversed, second, (first));

struct Aligned {
  alignas(32) std::array<float, 3> force;
  bool valid;
};
ARMATURE_STRUCT(Aligned, force, valid);

class Arm {
 public:
  struct State {
    double q;
  };
};
ARMATURE_STRUCT(Arm::State, q);

namespace elsewhere {
// The same name as armature::types::Pose, and the same fields.
struct Pose {
  double x;
  double y;
};
ARMATURE_STRUCT(Pose, x, y);

struct Reversed {
  int first;
  double second;
};
ARMATURE_STRUCT(Reversed, first, second);
}  // namespace elsewhere

}  // namespace robot

struct AtGlobalScope {
  int a;
};
ARMATURE_STRUCT(AtGlobalScope, a);

namespace armature::types {
namespace {

TEST(TypeOf, NamesEveryKind) {
  EXPECT_EQ(type_of<bool>().name, "bool");
  EXPECT_EQ(type_of<std::int8_t>().name, "int8");
  EXPECT_EQ(type_of<std::uint8_t>().name, "uint8");
  EXPECT_EQ(type_of<std::int16_t>().name, "int16");
  EXPECT_EQ(type_of<std::uint16_t>().name, "uint16");
  EXPECT_EQ(type_of<std::int32_t>().name, "int32");
  EXPECT_EQ(type_of<std::uint32_t>().name, "uint32");
  EXPECT_EQ(type_of<std::int64_t>().name, "int64");
  EXPECT_EQ(type_of<std::uint64_t>().name, "uint64");
  EXPECT_EQ(type_of<float>().name, "float");
  EXPECT_EQ(type_of<double>().name, "double");
  EXPECT_EQ(type_of<std::string>().name, "text");
  EXPECT_EQ(type_of<base::FixedText<31>>().name, "text<31>");
  EXPECT_EQ((type_of<std::array<float, 3>>().name), "array<float,3>");
  EXPECT_EQ((type_of<std::vector<std::array<double, 2>>>().name), "vector<array<double,2>>");
  EXPECT_EQ(type_of<std::vector<Pose>>().name, "vector<Pose>");
  EXPECT_EQ(type_of<robot::Arm::State>().name, "Arm::State");
  EXPECT_EQ(type_of<AtGlobalScope>().name, "AtGlobalScope");
}

TEST(TypeOf, IsTheSameForTheSameType) {
  EXPECT_EQ(&type_of<Pose>(), &type_of<Pose>());
  EXPECT_EQ(&type_of<const double>(), &type_of<double>());
  EXPECT_EQ(&type_of<long long>(), &type_of<std::int64_t>());
}

TEST(TypeOf, GivesSizeAlignmentAndElements) {
  const Type& array = type_of<std::array<Pose, 4>>();
  EXPECT_EQ(array.kind, Kind::kArray);
  EXPECT_EQ(array.size, sizeof(std::array<Pose, 4>));
  EXPECT_EQ(array.count, 4u);
  EXPECT_EQ(array.element, &type_of<Pose>());
  EXPECT_EQ(type_of<base::FixedText<9>>().count, 9u);
  EXPECT_EQ(type_of<robot::Aligned>().alignment, 32u);
}

TEST(TypeOf, KnowsWhatGrows) {
  EXPECT_TRUE(type_of<double>().fixed_size());
  EXPECT_TRUE(type_of<base::FixedText<8>>().fixed_size());
  EXPECT_TRUE((type_of<std::array<Pose, 3>>().fixed_size()));
  EXPECT_FALSE(type_of<std::string>().fixed_size());
  EXPECT_FALSE((type_of<std::array<std::vector<int>, 3>>().fixed_size()));
  EXPECT_FALSE(type_of<Everything>().fixed_size());
}

TEST(Struct, GivesEachFieldWithItsPlaceUnitAndDocumentation) {
  const Type& type = type_of<Pose>();
  EXPECT_EQ(type.kind, Kind::kStruct);
  ASSERT_EQ(type.fields.size(), 2u);
  EXPECT_EQ(type.fields[0].name, "x");
  EXPECT_EQ(type.fields[0].offset, 0u);
  EXPECT_EQ(type.fields[0].type, &type_of<double>());
  EXPECT_EQ(type.fields[0].unit, "m");
  EXPECT_EQ(type.fields[0].doc, "ahead of the dock");
  EXPECT_EQ(type.fields[1].offset, sizeof(double));
  EXPECT_EQ(type.fields[1].doc, "");
  EXPECT_EQ(type_of<Everything>().fields[0].unit, "");
}

TEST(Struct, TakesManyFields) {
  const Type& type = type_of<robot::Wide>();
  ASSERT_EQ(type.fields.size(), 30u);
  EXPECT_EQ(type.fields[29].name, "a30");
  EXPECT_EQ(type.fields[29].offset, 29 * sizeof(int));
}

TEST(Struct, ListsItsFieldsInTheOrderOfTheDescription) {
  EXPECT_EQ(layout_text(type_of<robot::Reversed>()), "Reversed{second:double,first:int32}");
  EXPECT_EQ(type_of<robot::Reversed>().fields[1].offset, 0u);
}

TEST(Struct, IsCheckedForFieldsThatAreMissingOrListedTwice) {
  using internal::Footprint;
  using internal::lists_each_field_once;
  constexpr Footprint kWhole{48, 8};
  static_assert(lists_each_field_once(kWhole, {{0, 24, 8}, {24, 24, 8}}));
  static_assert(lists_each_field_once(kWhole, {{24, 24, 8}, {0, 24, 8}}));
  static_assert(!lists_each_field_once(kWhole, {{0, 24, 8}}));
  static_assert(!lists_each_field_once(kWhole, {{24, 24, 8}}));
  static_assert(!lists_each_field_once(kWhole, {{0, 24, 8}, {0, 24, 8}, {24, 24, 8}}));
  static_assert(!lists_each_field_once(kWhole, {}));
  static_assert(!lists_each_field_once({72, 8}, {{0, 24, 8}, {48, 24, 8}}));
  static_assert(lists_each_field_once({16, 8}, {{0, 1, 1}, {8, 8, 8}}));
}

TEST(Layout, WritesOutEveryStructInside) {
  EXPECT_EQ(layout_text(type_of<Pose>()), "Pose{x:double,y:double}");
  EXPECT_EQ((layout_text(type_of<std::array<std::vector<Pose>, 2>>())),
            "array<vector<Pose{x:double,y:double}>,2>");
}

// These numbers are in files and on the wire: they never change.
TEST(Hash, IsFnv1aOfTheLayout) {
  EXPECT_EQ(type_of<Pose>().hash, base::fnv1a("Pose{x:double,y:double}"));
  EXPECT_EQ(type_of<double>().hash, 0xa0eb0f08u);
  EXPECT_EQ(type_of<std::vector<double>>().hash, 0x9bf69ffbu);
  EXPECT_EQ(type_of<Pose>().hash, 0xc26cac1bu);
}

TEST(SameType, ComparesNameFieldsAndMemory) {
  EXPECT_TRUE(same_type(type_of<Pose>(), type_of<robot::elsewhere::Pose>()));
  EXPECT_TRUE(
      same_type(type_of<std::vector<Pose>>(), type_of<std::vector<robot::elsewhere::Pose>>()));
  EXPECT_FALSE(same_type(type_of<Pose>(), type_of<AtGlobalScope>()));
  EXPECT_FALSE(same_type(type_of<std::vector<double>>(), type_of<std::vector<float>>()));
  EXPECT_FALSE(same_type(type_of<robot::Reversed>(), type_of<robot::elsewhere::Reversed>()));
}

TEST(SameType, NoticesFieldsAtOtherPlaces) {
  Type moved = type_of<Pose>();
  std::swap(moved.fields[0].offset, moved.fields[1].offset);
  EXPECT_FALSE(same_type(type_of<Pose>(), moved));
  EXPECT_TRUE(same_type(type_of<Pose>(), Type(type_of<Pose>())));
}

TEST(SameShape, IsTrueWithoutVectorsAndText) {
  const Pose a{1, 2};
  const Pose b{3, 4};
  EXPECT_TRUE(same_shape(type_of<Pose>(), &a, &b));
}

TEST(SameShape, ComparesSizesAtEveryLevel) {
  const Type& type = type_of<Everything>();
  const Everything a = make_everything();
  Everything b = a;
  b.q[0] = 9;
  b.text[0] = '?';
  EXPECT_TRUE(same_shape(type, &a, &b));
  b.tables[1].pop_back();
  EXPECT_FALSE(same_shape(type, &a, &b));
  b = a;
  b.names[1] += "longer";
  EXPECT_FALSE(same_shape(type, &a, &b));
  b = a;
  b.path.clear();
  EXPECT_FALSE(same_shape(type, &a, &b));
}

TEST(VisitLeaves, NamesEveryScalarAndTextInOrder) {
  Everything value;
  value.q = {1, 2};
  value.path = {{5, 6}};
  value.names = {"n"};
  std::string paths;
  visit_leaves(type_of<Everything>(), &value,
               [&](const std::string& path, const Type&, const void*) { paths += path + " "; });
  EXPECT_EQ(
      paths,
      "on i8 u8 i16 u16 i32 u32 i64 u64 f d gait text label flags[0] flags[1] flags[2] q[0] q[1] "
      "pose.x pose.y path[0].x path[0].y names[0] ");
}

TEST(VisitLeaves, GivesTypeAndValueAndStartsAtThePathGiven) {
  const std::vector<std::array<int, 2>> value{{1, 2}, {3, 4}};
  std::string seen;
  visit_leaves(
      type_of<std::vector<std::array<int, 2>>>(), &value,
      [&](const std::string& path, const Type& type, const void* leaf) {
        seen += path + " " + type.name + " " + to_text(type, leaf) + "; ";
      },
      "m");
  EXPECT_EQ(seen, "m[0][0] int32 1; m[0][1] int32 2; m[1][0] int32 3; m[1][1] int32 4; ");
}

TEST(VisitLeaves, VisitsAScalarItself) {
  const double value = 4;
  int visits = 0;
  visit_leaves(type_of<double>(), &value,
               [&](const std::string& path, const Type&, const void* at) {
                 EXPECT_EQ(path, "");
                 EXPECT_EQ(at, &value);
                 ++visits;
               });
  EXPECT_EQ(visits, 1);
}

}  // namespace
}  // namespace armature::types
