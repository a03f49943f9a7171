/// The folder of a run: nothing in it that is another's is lost, and what it holds is of one run.
///
/// A run's files are written aside and land together by renaming, summary.json as the last; until
/// then the files of an earlier run stay as they were. Only where there are none do steps land one
/// by one, and what was measured with them, for who watches. run.json says all along whose the
/// files are (run_record.h). Laws: (1) a file that was read in this process, that run.json does not
/// list with these very bytes, or that is a link, is neither replaced nor removed; (2) where
/// summary.json lies, all other files but measurements.csv are of its run; (3) one process writes
/// at a time; (4) after a run that died, the next one leaves what it would have left without, and
/// perhaps measurements.csv.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/folder_lock.h"
#include "scene/interrupt.h"
#include "scene/run_record.h"
#include "scene/staging.h"

namespace palpation::tool {

/// What is to be written into a folder, and for whom.
struct RunRequest {
  std::string command;
  std::string question;    ///< in any words: equal for the same run again
  nlohmann::json begun{};  ///< for the record, until there is a summary
  bool overwrite = false;  ///< the run of another question
  /// Whether measurements.csv is of what is written, or left alone wherever it comes from.
  bool measures = false;
};

class RunFolder {
 public:
  /// Makes the folder if it is not there, locks it, and looks at what lies in it before anything is
  /// computed. Throws IoError where something would be lost, WriteError where nothing can be
  /// written.
  RunFolder(std::filesystem::path folder, RunRequest request);
  /// What has not landed is taken away, and run.json says why there is no more.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  using Write = std::function<void(const std::filesystem::path&)>;
  /// A file of the set, by a function that writes to the path it is given.
  void add(const std::string& name, const Write& write);
  /// The same of the content.
  void add(const std::string& name, const std::string& content);
  /// A step, "step_007.vtp".
  void add_step(const std::string& name, const Write& write);
  /// A file of the set that says how far the run came: where steps land one by one, it lands with
  /// them, again and again; else once, with the others.
  void add_growing(const std::string& name, const Write& write);
  /// Takes what `make` leaves, of these names, in the folder where the set waits to land.
  void add_made(const std::vector<std::string>& names, const Write& make);
  /// All at once, or as good as: the summary comes last.
  void land();

  const std::filesystem::path& path() const { return folder_; }
  /// Where a file of the set is before it lands; of one that landed already, where it lies.
  std::filesystem::path place_of(const std::string& name) const;

 private:
  void look_around();
  void take_over(const RunRecord& earlier);
  void look_at_steps() const;
  void look_again();
  void refuse_what_is_not_ours(const std::string& name) const;
  void stage(const std::string& name, const Write& write);
  void enter(const std::string& name);
  void record(const std::string& state);
  void say(const std::string& state);
  void remove_replaced();
  void move_in(const std::string& name);
  bool lands(const std::string& name) const;

  std::filesystem::path folder_;
  RunRequest request_;
  FolderLock lock_;
  std::optional<Staging> staging_;
  Fingerprints earlier_;          // files that lie here and are ours, of an earlier run
  RunRecord record_;              // of this run; its state is empty while there is none
  std::vector<std::string> set_;  // what waits to land
  bool alone_ = true;             // there is no earlier run to be kept until this one lands
  std::timed_mutex guard_;        // of what changes the folder, against the last words
  std::optional<LastWords> last_words_;
};

}  // namespace palpation::tool
