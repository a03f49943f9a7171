#include "readings/lost_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "palpation/base/random.h"

namespace palpation {
namespace {

using Numbers = std::vector<std::size_t>;

/// A lattice of healthy readings with a tumour in the middle.
struct Lattice {
  std::vector<Vec3> places{};
  std::vector<Palpation> palpations{};

  explicit Lattice(double tumour_m) {
    Random random(3);
    for (int row = 0; row < 8; ++row) {
      for (int column = 0; column < 8; ++column) {
        places.emplace_back(0.003 * column, 0.003 * row, 0.0);
        const bool is_stiff = (places.back() - Vec3(0.0105, 0.0105, 0.0)).norm() < tumour_m;
        palpations.emplace_back();
        palpations.back().reading = (is_stiff ? 9.0 : 7.0) + 0.1 * random.normal();
      }
    }
  }
};

TEST(LostContact, IsFarBelowAllOthersHereAndThere) {
  Lattice felt(0.005);
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), Numbers{});
  const Numbers lost{0, 5, 13, 14, 27, 40, 63};
  for (const std::size_t i : lost) felt.palpations[i].reading = 0.0;
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), lost);
  felt.palpations[33].reading = 4000.0;  // one that is wild hides none of them
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), lost);
}

// Healthy tissue that a tumour leaves at one end lies in one piece.
TEST(LostContact, IsNotTheOneEndOfTheTissueThatIsSoft) {
  Lattice felt(1.0);
  for (std::size_t i = 0; i < 16; ++i) felt.palpations[i].reading = 3.0;
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), Numbers{});
}

// Sixteen touches over all of the tissue, then a hundred on a lump that the first found.
TEST(LostContact, IsNotTheTissueAroundALumpThatWasTouchedMost) {
  Random random(5);
  Lattice felt(0.0);
  felt.places.clear();
  felt.palpations.clear();
  const auto touch = [&](const Vec3& place) {
    felt.places.push_back(place);
    const bool is_stiff = (place - Vec3(0.024, 0.027, 0.0)).norm() < 0.009;
    felt.palpations.emplace_back();
    felt.palpations.back().reading = (is_stiff ? 18.0 : 10.0) + 0.4 * random.normal();
  };
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      touch(Vec3(0.004 + 0.014 * column, 0.004 + 0.014 * row, 0.0));
  }
  for (int i = 0; i < 100; ++i) {
    const double angle = 6.283 * random.uniform(), far_m = 0.008 * std::sqrt(random.uniform());
    touch(Vec3(0.024, 0.027, 0.0) + far_m * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), Numbers{});
  felt.palpations[50].reading = felt.palpations[80].reading = 0.0;
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), (Numbers{50, 80}));
}

TEST(LostContact, IsFarBelowItsOwnSessionNotAnother) {
  Lattice felt(0.005);
  const Numbers later{1, 6, 9, 14, 19, 22, 27, 33, 38, 44, 49, 60};
  for (const std::size_t i : later) {
    felt.palpations[i].session = 1;
    felt.palpations[i].reading -= 50.0;  // its zero
  }
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), Numbers{});
  felt.palpations[27].reading = felt.palpations[40].reading = -100.0;
  EXPECT_EQ(lost_contact(felt.palpations, felt.places), (Numbers{27, 40}));
}

TEST(LostContact, IsNotAskedOfFewReadingsNorOfThoseThatTellNothing) {
  const Lattice felt(0.005);
  std::vector<Palpation> few(felt.palpations.begin(), felt.palpations.begin() + 9);
  few[4].reading = 0.0;
  EXPECT_EQ(lost_contact(few, felt.places), Numbers{});
  std::vector<Palpation> told = felt.palpations;
  told[7].reading = 0.0;
  told[7].set_aside = "the probe slipped";
  told[9].kind = TouchKind::Missed;
  EXPECT_EQ(lost_contact(told, felt.places), Numbers{});
}

}  // namespace
}  // namespace palpation
