// `relaxation` beside the laws of rubber: keys, what is refused, and the energies of a run in time.
#include <gmock/gmock.h>

#include "osculate/model/material_memory.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

constexpr const char* seal = R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}}}
materials: {m: {rubber: {c10: 1, d1: 0.1}, relaxation: {shear: [[0.3, 1]]}}}
sections: [{on: b, material: m, element: plane_strain}]
steps:
  - {name: pull, increments: 4, duration: 1, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: b.right, ux: 0.4, uy: 0.3}]}
)";
std::string sealed(const std::string& from, const std::string& to) {
  return edited(seal, from, to);
}

TEST(RelaxationKey, StandsBesideALawOfRubber) {
  const model::Model m = build_text(seal).model;
  const material::Law& law = m.sections[0].section.law;
  EXPECT_EQ(material::key_of(law), "rubber");
  EXPECT_EQ(m.sections[0].section.kinematics, solid::Kinematics::finite);
  EXPECT_EQ(m.sections[0].section.formulation, solid::Formulation::bbar);
  EXPECT_EQ(material::memory_of(law).size(), 26U);
  EXPECT_TRUE(material::needs_duration(law));
  // the order of the keys does not matter
  const model::Model other =
      build_text(sealed("{rubber: {c10: 1, d1: 0.1}, relaxation: {shear: [[0.3, 1]]}}",
                        "{relaxation: {shear: [[0.3, 1]]}, rubber: {c10: 1, d1: 0.1}}"))
          .model;
  EXPECT_EQ(material::memory_of(other.sections[0].section.law).size(), 26U);
}

TEST(RelaxationKey, WhatDoesNotGoTogetherIsRefused) {
  const auto law = [](const std::string& to) {
    return refusal(sealed("rubber: {c10: 1, d1: 0.1}", to));
  };
  const auto series = [](const std::string& to) {
    return refusal(sealed("{shear: [[0.3, 1]]}", to));
  };
  EXPECT_EQ(law("ogden: {mu1: 1, alpha1: 2, d1: 0.1}"), "");
  EXPECT_EQ(law("arruda_boyce: {mu: 1, lambda_m: 2, d: 0.1}"), "");
  EXPECT_THAT(law("st_venant_kirchhoff: {E: 1, nu: 0.3}"),
              HasSubstr("materials.m.relaxation: st_venant_kirchhoff has none; neo_hooke, rubber, "
                        "ogden, hyperfoam, arruda_boyce may have one, and `viscoelastic` is "
                        "Hooke's law with its own series"));
  EXPECT_THAT(law("viscoelastic: {E: 1, nu: 0.3, shear: [[0.3, 1]]}"),
              HasSubstr("materials.m.relaxation: viscoelastic has none"));
  for (const char* const whole :
       {"neo_hooke: {E: 1, nu: 0.3}", "hyperfoam: {mu1: 1, alpha1: 2, nu1: 0.2}"})
    EXPECT_THAT(law(whole), HasSubstr("shape and volume relax alike: give `bulk` the terms of "
                                      "`shear`"));
  EXPECT_EQ(refusal(sealed("rubber: {c10: 1, d1: 0.1}, relaxation: {shear: [[0.3, 1]]}",
                           "neo_hooke: {E: 1, nu: 0.3}, relaxation: {shear: [[0.3, 1]], bulk: "
                           "[[0.3, 1]]}")),
            "");
  EXPECT_THAT(series("{}"), HasSubstr("give `shear` or `bulk`: without, nothing relaxes"));
  EXPECT_THAT(series("{shear: [[1.3, 1]]}"),
              HasSubstr("relaxation.shear: the sum of the shares is less than 1"));
  EXPECT_THAT(series("{shear: [[0.3, 1]], bulk: [[0.1, 0]]}"),
              HasSubstr("relaxation.bulk[0]: times are greater than 0"));
  EXPECT_THAT(series("{sheer: [[0.3, 1]]}"), HasSubstr("did you mean 'shear'"));
  EXPECT_THAT(build_refusal(sealed(", duration: 1", "")),
              HasSubstr("material 'm', which depends on time,"));
}

}  // namespace
}  // namespace osculate::deck
