#include "scene/session_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/normal.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kSessionsTold = 5;
constexpr int kFewInSession = 3;
constexpr double kFalseAlarms = 0.05;  // in all sessions

std::string ordinal(int number) {
  const bool is_teen = number % 100 / 10 == 1;
  const char* end = is_teen || number % 10 > 3 || number % 10 == 0 ? "th"
                    : number % 10 == 1                             ? "st"
                    : number % 10 == 2                             ? "nd"
                                                                   : "rd";
  return std::to_string(number) + end;
}

/// Beyond as many standard deviations some of so many sessions, which do not differ, hardly seem to
/// (Bonferroni).
double surely_seen(std::size_t sessions) {
  return normal_quantile(1.0 - 0.5 * kFalseAlarms / static_cast<double>(sessions));
}

/// Whether it is not 1; `seen` standard deviations.
bool is_a_gain(const DrawnNumber& gain, double seen) {
  const double wider = seen / surely_seen(1);
  return gain.mean - wider * (gain.mean - gain.least) > 1.0 ||
         gain.mean + wider * (gain.most - gain.mean) < 1.0;
}

/// Nothing where its zero and gain may be those of the one before.
std::string changed_words(ReadingScale scale, const SessionChange& session, double seen) {
  const bool has_zero = std::abs(session.zero.amount) >= seen * session.zero.stddev;
  const bool has_gain = session.gain && is_a_gain(*session.gain, seen);
  if (!has_zero && !has_gain) return "";
  std::string words = "The " + session_name(session.zero.session) + ", which begins with reading " +
                      std::to_string(session.zero.number + 1) + ",";
  if (has_zero)
    words += " has a zero of its own: its readings lie " + raised_words(scale, session.zero.amount);
  if (has_gain)
    words += std::string(has_zero ? ", and" : " has a gain of its own:") +
             " what stands out does so " + fixed(session.gain->mean, 2) + " times as much (" +
             fixed(session.gain->least, 2) + " to " + fixed(session.gain->most, 2) + ")";
  return words + ". That is taken from them.";
}

/// In a line, where there are many.
std::vector<std::string> changed_words(ReadingScale scale,
                                       std::span<const SessionChange> sessions) {
  std::vector<std::string> words;
  const double seen = sessions.empty() ? 0.0 : surely_seen(sessions.size());
  for (const SessionChange& session : sessions)
    words.push_back(changed_words(scale, session, seen));
  std::erase(words, "");
  if (words.size() <= kSessionsTold) return words;
  return {"Of " + std::to_string(sessions.size() + 1) + " sessions " +
          std::to_string(words.size()) +
          " have zeros or gains of their own, which are taken from their readings: taken_back of " +
          "summary.json has them."};
}

/// Where a model does not let them differ; else nothing.
std::string sessions_as_one_words(const Conclusion& conclusion) {
  int last = 0;
  for (const Palpation& one : conclusion.palpations) last = std::max(last, one.session);
  const auto is_of_session = [](const Misfit& change) { return change.session > 0; };
  if (last == 0 || std::ranges::any_of(conclusion.evidence.taken_back, is_of_session)) return "";
  return "Readings are of " + std::to_string(last + 1) +
         " sessions, whose zeros are taken to be one: " +
         (conclusion.model.field.is_noiseless()    ? "the field has no noise"
          : conclusion.model.field.trend.is_linear ? "field.trend is linear, which trades with them"
                                                   : "too few of them count to tell them apart") +
         ".";
}

/// What a session's zero takes of few readings.
std::string short_sessions_words(const Conclusion& conclusion) {
  std::map<int, int> readings;
  for (const Palpation& one : conclusion.palpations) readings[one.session] += counts(one);
  const auto few = std::ranges::count_if(
      readings, [](const auto& session) { return session.second < kFewInSession; });
  if (readings.size() < 2 || few == 0) return "";
  return counted(static_cast<std::size_t>(few), "session") + " of " +
         std::to_string(readings.size()) + " " + (few == 1 ? "has" : "have") + " fewer than " +
         std::to_string(kFewInSession) +
         " readings that count: what they tell goes to the zero of their session, and hardly any "
         "of it to the tissue. Readings of one zero are of one session.";
}

}  // namespace

std::string raised_words(ReadingScale scale, double amount) {
  if (scale == ReadingScale::Log) return fixed(std::exp(amount), 2) + " times as high as before";
  return reading_text(std::abs(amount)) + (amount > 0.0 ? " higher" : " lower") + " than before";
}

std::string session_name(int session) { return ordinal(session + 1) + " session"; }

std::vector<std::string> session_words(const Conclusion& conclusion) {
  std::vector<std::string> words = changed_words(conclusion.scale(), session_changes(conclusion));
  words.push_back(sessions_as_one_words(conclusion));
  words.push_back(short_sessions_words(conclusion));
  return words;
}

}  // namespace palpation::tool
