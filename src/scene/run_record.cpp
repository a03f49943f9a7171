#include "scene/run_record.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scene/run_files.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr const char* kProgram = "palpate";

class Fnv {
 public:
  void take(std::string_view bytes) {
    for (const char byte : bytes) state_ = (state_ ^ static_cast<unsigned char>(byte)) * kPrime;
  }
  std::string digits() const {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(state_));
    return text.data();
  }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3u;
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// Piece by piece; not by read_file, since what this program looks at is not what it was given.
/// False unless it is a regular file that can be read, and not a link to one.
bool read_pieces(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& take) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return false;
  struct ::stat status {};
  bool good = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  std::array<char, 1 << 16> bytes;
  for (ssize_t count = 1; good && count != 0;) {
    count = ::read(file, bytes.data(), bytes.size());
    if (count < 0) good = false;
    if (count > 0) take(std::string_view(bytes.data(), static_cast<std::size_t>(count)));
  }
  ::close(file);
  return good;
}

/// No other names than those of a run: a record that was tampered with gives away no file.
Fingerprints fingerprints_in(const json& object, const char* key) {
  Fingerprints result;
  if (!object.contains(key) || !object[key].is_object()) return result;
  for (const auto& [name, fingerprint] : object[key].items())
    if (fingerprint.is_string() && is_run_file(name)) result[name] = fingerprint;
  return result;
}

}  // namespace

bool RunRecord::owns(const std::string& name, const std::string& fingerprint) const {
  const auto lists = [&](const Fingerprints& some) {
    const auto found = some.find(name);
    return found != some.end() && found->second == fingerprint;
  };
  return lists(files) || lists(replaces);
}

std::optional<RunRecord> read_run_record(const std::filesystem::path& folder) {
  std::string text;
  if (!read_pieces(folder / kRecordName, [&](std::string_view piece) { text += piece; }))
    return std::nullopt;
  const json object = json::parse(text, nullptr, /*allow_exceptions=*/false);
  const auto word = [&](const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : "";
  };
  if (!object.is_object() || word("program") != kProgram) return std::nullopt;
  return RunRecord{word("command"),
                   word("question"),
                   word("state"),
                   fingerprints_in(object, "files"),
                   fingerprints_in(object, "replaces"),
                   object.value("begun", json())};
}

std::string document(const RunRecord& record) {
  json object = {{"program", kProgram},         {"version", PALPATION_VERSION},
                 {"command", record.command},   {"state", record.state},
                 {"question", record.question}, {"files", json::object()}};
  for (const auto& [name, fingerprint] : record.files) object["files"][name] = fingerprint;
  for (const auto& [name, fingerprint] : record.replaces) object["replaces"][name] = fingerprint;
  if (!record.begun.is_null()) object["begun"] = record.begun;
  return object.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string fingerprint_of_text(const std::string& text) {
  Fnv state;
  state.take(text);
  return state.digits();
}

std::optional<std::string> fingerprint_of_file(const std::filesystem::path& path) {
  const bool but_numbers = path.filename() == kTimingsName;
  Fnv state;
  const auto take = [&](std::string_view bytes) {
    if (!but_numbers) return state.take(bytes);
    std::string words(bytes);
    std::erase_if(words, [](char c) {
      return std::string_view("0123456789.+-e").find(c) != std::string_view::npos;
    });
    state.take(words);
  };
  if (!read_pieces(path, take)) return std::nullopt;
  return state.digits();
}

}  // namespace palpation::tool
