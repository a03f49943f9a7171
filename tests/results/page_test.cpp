#include "results/page.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "results/limits.h"
#include "results/pack.h"
#include "results/sha256.h"

namespace palpation::results {
namespace {

const std::string kMark = "\xEF\xBF\xBD";  // U+FFFD

TEST(Page, ShowsMarkupAndNeverActsOnIt) {
  EXPECT_EQ(escaped("<a href=\"x\" title='y'>&amp;"),
            "&lt;a href=&quot;x&quot; title=&#39;y&#39;&gt;&amp;amp;");
  EXPECT_EQ(escaped("mm\u00b2 \u2264 \U0001F600"), "mm\u00b2 \u2264 \U0001F600");
}

TEST(Page, MarksWhatIsNoText) {
  EXPECT_EQ(escaped("a\xFF!"), "a" + kMark + "!");
  EXPECT_EQ(escaped(std::string("a\0b", 3)), "a" + kMark + "b");
  EXPECT_EQ(escaped("\xC0\xBC!"), kMark + kMark + "!");       // < in two bytes
  EXPECT_EQ(escaped("\xED\xA0\x80"), kMark + kMark + kMark);  // half of a pair
  EXPECT_EQ(escaped("cut \xE2\x89"), "cut " + kMark + kMark);
}

TEST(Page, KeepsDataFromEndingTheirScript) {
  EXPECT_EQ(inert("{\"a\":\"</script><!--&\"}"),
            "{\"a\":\"\\u003c/script\\u003e\\u003c!--\\u0026\"}");
}

TEST(Page, RoundsForPeopleAndKeepsTheExactValueBeside) {
  EXPECT_EQ(rounded(122.70580335652488, 3), "123");
  EXPECT_EQ(rounded(0.36972, 3), "0.370");
  EXPECT_EQ(rounded(105.0, 9), "105");
  EXPECT_EQ(rounded(123456.7, 3), "123457");
  EXPECT_EQ(rounded(-0.00123, 2), "-0.0012");
  EXPECT_EQ(shown(0.1, 2, "a.b"), "<data data-key=\"a.b\" value=\"0.1\">0.10</data>");
  EXPECT_EQ(shown(std::nullopt, 2, "a"), "\u2013");
}

TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(sha256_digits(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_digits("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_digits("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_digits(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

TEST(Pack, TakesTheRangeInEqualSteps) {
  const nlohmann::json eight = packed(std::vector<double>{1.0, 2.0, 1.5}, 8);
  EXPECT_EQ(eight["low"], 1.0);
  EXPECT_EQ(eight["high"], 2.0);
  EXPECT_EQ(eight["values"], base64(std::string("\x00\xFF\x80", 3)));
  EXPECT_EQ(packed(std::vector<double>{3.0, 3.0}, 16)["values"], base64(std::string(4, '\0')));
}

TEST(Quantile, IsNotMovedByOneValueFarFromAllOthers) {
  std::vector<double> values(1000, 7.0);
  values[3] = 1e9;
  EXPECT_EQ(quantile(values, 0.995), 7.0);
  EXPECT_EQ(quantile(values, 1.0), 1e9);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

TEST(Limits, OfAMeanAreNotMovedByOneReadingFarFromAllOthers) {
  std::vector<double> mean(1000, 7.0);
  for (std::size_t i = 0; i < 100; ++i) mean[i] = 9.0;
  const Limits calm = limits_of_mean(mean, 8.0, 0.0);
  EXPECT_EQ(calm.lowest, 7.0);
  EXPECT_EQ(calm.highest, 9.0);
  for (std::size_t i = 500; i < 515; ++i) mean[i] = 90.0;  // what one reading moves
  const Limits hot = limits_of_mean(mean, 8.0, 0.0);
  EXPECT_EQ(hot.lowest, 7.0);
  EXPECT_EQ(hot.highest, 9.0);
}

TEST(Limits, WithoutALevelAreNoNarrowerThanTheNoise) {
  const Limits limits = limits_of_mean({7.0, 7.01, 6.99}, std::nullopt, 0.5);
  EXPECT_NEAR(limits.lowest, 5.5, 1e-12);
  EXPECT_NEAR(limits.highest, 8.5, 1e-12);
  EXPECT_EQ(limits_from_zero({0.2, 0.4, 0.3}).lowest, 0.0);
  EXPECT_EQ(limits_from_zero({0.2, 0.4, 0.3}).highest, 0.4);
  EXPECT_GT(limits_from_zero({}).highest, 0.0);
}

}  // namespace
}  // namespace palpation::results
