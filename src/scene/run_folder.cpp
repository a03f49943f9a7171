#include "scene/run_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "io/files_read.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/make_folder.h"
#include "scene/run_files.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kElsewhere = ": give another folder";

fs::path made(fs::path folder) {
  make_folder(folder);
  return folder;
}

bool is_in_steps(const std::string& name) { return name.starts_with("steps/"); }

/// What lands before the run is whole.
bool lands_early(const std::string& name) { return is_in_steps(name) || name == kStepsListName; }

/// Of a run that ended, what was measured is kept until the next one is whole.
bool did_not_end(const std::optional<RunRecord>& record) {
  return record && record->state != "complete" && record->state != "landing";
}

/// Not through a link.
std::optional<struct ::stat> status_of(const fs::path& path) {
  struct ::stat status {};
  if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

bool is_link(const fs::path& path) {
  const auto status = status_of(path);
  return status && S_ISLNK(status->st_mode);
}

void refuse_link(const fs::path& path) {
  if (is_link(path))
    throw IoError(path.string() + ": is a link, and nothing is written through one" + kElsewhere);
}

void remove_file(const fs::path& path) {
  std::error_code failure;
  fs::remove(path, failure);
  if (failure)
    throw WriteError(path.string() +
                     ": cannot remove what an earlier run left: " + failure.message());
}

}  // namespace

RunFolder::RunFolder(fs::path folder, RunRequest request)
    : folder_(made(std::move(folder))),
      request_(std::move(request)),
      lock_(folder_, request_.command),
      record_{.command = request_.command,
              .question = fingerprint_of_text(request_.question),
              .state = "",
              .begun = std::move(request_.begun)} {
  look_around();
  staging_.emplace(folder_);
  // The lock is not given back: what runs on must not write over these words.
  last_words_.emplace([this] {
    if (guard_.try_lock_for(1s)) say("interrupted");
  });
  if (!alone_) return;
  const std::lock_guard lock(guard_);
  record_.replaces = earlier_;
  record("in progress");
}

RunFolder::~RunFolder() {
  last_words_.reset();
  const std::lock_guard lock(guard_);
  say(is_interrupted() ? "interrupted" : "failed");
}

/// How it ended, where nothing else lies here; that it failed before there was anything is no run.
void RunFolder::say(const std::string& state) {
  if (record_.state.empty() || record_.state == "complete") return;
  try {
    if (state == "failed" && record_.files.empty() && earlier_.empty()) {
      remove_file(folder_ / kRecordName);
    } else {
      record(state);
    }
  } catch (const std::exception&) {
    // On a full disk it stays in progress, of a process that is gone.
  }
}

/// Before hours of work, not after them.
void RunFolder::look_around() {
  const std::optional<RunRecord> earlier = read_run_record(folder_);
  if (!earlier && status_of(folder_ / kRecordName))
    throw IoError((folder_ / kRecordName).string() +
                  ": is none of palpate's, and would be replaced" + kElsewhere);
  if (earlier) take_over(*earlier);
  if (request_.measures) look_at_steps();
  for (const std::string name : kRunFiles)
    if (name != kMeasurementsName || request_.measures) refuse_what_is_not_ours(name);
  const bool is_other = earlier && earlier->question != record_.question;
  if (is_other && !earlier_.empty() && !request_.overwrite)
    throw IoError(folder_.string() + ": holds a run of palpate " + earlier->command + " (" +
                  earlier->state +
                  ") of another question: replace it by --overwrite, or give another folder");
  alone_ = std::ranges::all_of(earlier_, [&](const auto& file) {
    return lands_early(file.first) || (file.first == kMeasurementsName && did_not_end(earlier));
  });
}

/// What an earlier run wrote, and nobody changed.
void RunFolder::take_over(const RunRecord& earlier) {
  const bool with_steps = !is_link(folder_ / kStepsName);
  for (const Fingerprints* some : {&earlier.files, &earlier.replaces}) {
    for (const auto& [name, fingerprint] : *some) {
      if (is_in_steps(name) && !with_steps) continue;
      if (fingerprint_of_file(folder_ / name) == fingerprint) earlier_[name] = fingerprint;
    }
  }
}

void RunFolder::look_at_steps() const {
  const fs::path steps = folder_ / kStepsName;
  if (!status_of(steps)) return;
  refuse_link(steps);
  make_folder(steps);
  for (const auto& entry : fs::directory_iterator(steps)) {
    const std::string name = entry.path().filename().string();
    if (is_step(name)) refuse_what_is_not_ours("steps/" + name);
  }
}

void RunFolder::refuse_what_is_not_ours(const std::string& name) const {
  const fs::path path = folder_ / name;
  if (is_in_steps(name)) refuse_link(path.parent_path());
  const auto status = status_of(path);
  if (!status || record_.files.contains(name)) return;
  if (was_read(*status))
    throw IoError(path.string() + ": was read in this run, and would be replaced" + kElsewhere);
  refuse_link(path);
  const auto listed = earlier_.find(name);
  if (listed != earlier_.end() && fingerprint_of_file(path) == listed->second) return;
  throw IoError(path.string() + ": is not as palpate wrote it (" + kRecordName +
                " lists what it did), and would be replaced: move it away, or give another folder");
}

void RunFolder::stage(const std::string& name, const Write& write) {
  try {
    write(*staging_ / name);
  } catch (const WriteError& error) {
    throw WriteError(staging_->without(error.what()));
  }
}

void RunFolder::add(const std::string& name, const Write& write) {
  stage(name, write);
  set_.push_back(name);
}

void RunFolder::add(const std::string& name, const std::string& content) {
  add(name, [&](const fs::path& path) { write_atomically(path, content); });
}

void RunFolder::add_made(const std::vector<std::string>& names, const Write& make) {
  make(staging_->path());
  for (const std::string& name : names)
    if (fs::exists(*staging_ / name)) set_.push_back(name);
}

void RunFolder::add_step(const std::string& name, const Write& write) {
  const std::string full = "steps/" + name;
  make_folder(*staging_ / kStepsName);
  stage(full, write);
  if (!alone_) return set_.push_back(full);
  const std::unique_lock lock(guard_);
  remove_replaced();
  refuse_what_is_not_ours(full);
  enter(full);
  record(record_.state);
  make_folder(folder_ / kStepsName);
  move_in(full);
  sync_folder(folder_ / kStepsName);
}

void RunFolder::add_growing(const std::string& name, const Write& write) {
  if (!alone_) return;
  stage(name, write);
  const std::unique_lock lock(guard_);
  refuse_what_is_not_ours(name);
  enter(name);
  record(record_.state);
  move_in(name);
  sync_folder(folder_);
}

fs::path RunFolder::place_of(const std::string& name) const {
  return fs::exists(*staging_ / name) ? *staging_ / name : folder_ / name;
}

/// Whoever is killed before it is renamed leaves the one before.
void RunFolder::enter(const std::string& name) {
  const std::optional<std::string> fingerprint = fingerprint_of_file(*staging_ / name);
  if (!fingerprint)
    throw WriteError((*staging_ / name).string() + ": cannot be read again: was it taken away?");
  if (const auto before = record_.files.find(name); before != record_.files.end())
    record_.replaces[name] = before->second;
  record_.files[name] = *fingerprint;
}

/// The record is there before what it lists: whoever is killed, what lies here is known as ours.
void RunFolder::record(const std::string& state) {
  RunRecord next = record_;
  next.state = state;
  stage(kRecordName, [&](const fs::path& path) { write_atomically(path, document(next)); });
  move_in(kRecordName);
  record_ = std::move(next);
  sync_folder(folder_);
}

void RunFolder::move_in(const std::string& name) {
  std::error_code failure;
  fs::rename(*staging_ / name, folder_ / name, failure);
  if (failure) throw WriteError((folder_ / name).string() + ": cannot write: " + failure.message());
}

/// What was measured stays until it is replaced: it may be all there is. The summary goes first.
void RunFolder::remove_replaced() {
  const auto remove = [&](const std::string& name) {
    refuse_what_is_not_ours(name);
    remove_file(folder_ / name);
  };
  if (earlier_.contains(kSummaryName)) {
    remove(kSummaryName);
    sync_folder(folder_);
  }
  bool steps = false;
  for (const auto& [name, fingerprint] : earlier_) {
    if (name == kSummaryName || name == kMeasurementsName || lands(name)) continue;
    remove(name);
    steps = steps || is_in_steps(name);
  }
  std::error_code holds_others;
  if (steps) fs::remove(folder_ / kStepsName, holds_others);
  std::erase_if(earlier_, [&](const auto& file) { return file.first != kMeasurementsName; });
}

bool RunFolder::lands(const std::string& name) const { return std::ranges::count(set_, name) > 0; }

void RunFolder::land() {
  const std::lock_guard lock(guard_);
  look_again();
  record_.replaces = earlier_;
  for (const std::string& name : set_) enter(name);
  record("landing");
  remove_replaced();
  if (std::ranges::any_of(set_, is_in_steps)) make_folder(folder_ / kStepsName);
  for (const std::string& name : set_)
    if (is_in_steps(name)) move_in(name);
  for (const std::string name : kRunFiles)
    if (lands(name)) move_in(name);
  if (fs::exists(folder_ / kStepsName)) sync_folder(folder_ / kStepsName);
  sync_folder(folder_);
  record_.replaces.clear();
  if (earlier_.contains(kMeasurementsName) && !lands(kMeasurementsName))
    record_.files[kMeasurementsName] = earlier_[kMeasurementsName];
  record_.begun = nullptr;
  record("complete");
}

/// A person may have changed something in the meantime.
void RunFolder::look_again() {
  try {
    for (const std::string& name : set_) refuse_what_is_not_ours(name);
    for (const auto& [name, fingerprint] : earlier_)
      if (name != kMeasurementsName) refuse_what_is_not_ours(name);
  } catch (const IoError& error) {
    staging_->keep();
    throw WriteError(std::string(error.what()) + " (what was computed is in " +
                     staging_->path().string() + " until the next run)");
  }
}

}  // namespace palpation::tool
