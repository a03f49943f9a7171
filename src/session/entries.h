/// The lines of a session's journal: how each is written, and what it does to the state.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "palpation/session/session_state.h"

namespace palpation {

inline constexpr const char* kJournalName = "journal.jsonl";

nlohmann::json first_entry(const SessionIdentity& identity);
/// `replans`: what is open of the last plan is dropped.
nlohmann::json change_entry(const SessionIdentity& identity, bool replans);
/// `measurements`: of the question, told by its checksum.
nlohmann::json plan_entry(const HandedOut& plan, const std::string& measurements);
nlohmann::json reading_entry(const SessionReading& reading, std::optional<int> stop,
                             const std::string& off_tissue);
nlohmann::json missed_entry(int stop, const std::string& why);
nlohmann::json withdrawn_entry(int number, const std::string& why);
nlohmann::json touch_entry(const Vec3& place);
nlohmann::json keep_out_entry(const KeepOut& ball);
nlohmann::json refusal_entry(const std::string& words);

/// Throws IoError, with `name` and the line, for an entry that this version does not know.
void apply(SessionState& state, const nlohmann::json& entry, const std::string& name);

/// The number of a plan, of an entry that is one; else -1.
int plan_number_of(const nlohmann::json& entry);

/// The rows that a plan made now is made from.
std::string rows_used(const SessionState& state);
/// And its batch.
int next_batch(const SessionState& state);

}  // namespace palpation
