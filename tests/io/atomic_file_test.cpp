#include "palpation/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "io/files_read.h"
#include "io/temporary_folder.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

long files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(WriteAtomically, ReplacesTheOldContentAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old and longer");
  write_atomically(path, std::string("new\0!", 5));
  EXPECT_EQ(read_file(path), std::string("new\0!", 5));
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(WriteAtomically, HandsTheWriterANameWithTheSameExtensionInTheSameFolder) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "picture.png";
  write_atomically(path, [&](const fs::path& name) {
    EXPECT_EQ(name.extension(), ".png");
    EXPECT_EQ(name.parent_path(), folder.path());
    EXPECT_NE(name, path);
    std::ofstream(name) << "pixels";
  });
  EXPECT_EQ(read_file(path), "pixels");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheWriterThrows) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old");
  const auto fail = [](const fs::path& name) {
    std::ofstream(name) << "half";
    throw std::runtime_error("stop");
  };
  EXPECT_THROW(write_atomically(path, fail), std::runtime_error);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(WriteAtomically, SaysWhenTheWriterLeftNoFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_atomically(folder.path() / "a.txt", [](const fs::path&) {}), WriteError);
}

TEST(WriteAtomically, NamesThePathAndTheReasonWhereTheFolderIsMissing) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "missing" / "a.txt";
  const std::string message = io_error_of([&] { write_atomically(path, "x"); });
  EXPECT_TRUE(contains(message, path.string())) << message;
  EXPECT_TRUE(contains(message, "No such file")) << message;
  EXPECT_THROW(write_atomically(path, "x"), WriteError);
}

TEST(WriteAtomically, NeverReplacesAFolderOrADevice) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_atomically(folder.path(), "x"), WriteError);
  EXPECT_THROW(write_atomically("/dev/null", "x"), WriteError);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteAtomically, WritesNothingThroughASymbolicLink) {
  const TemporaryFolder folder;
  const fs::path target = folder.file("target.txt", "old"), link = folder.path() / "link.txt";
  fs::create_symlink(target, link);
  const std::string message = io_error_of([&] { write_atomically(link, "new"); });
  EXPECT_TRUE(contains(message, "link.txt: cannot write: is a link")) << message;
  EXPECT_EQ(read_file(target), "old");
  EXPECT_TRUE(fs::is_symlink(link));
  fs::remove(target);
  EXPECT_THROW(write_atomically(link, "new"), WriteError) << "nor is its target made";
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(ReadFile, IsRememberedByWhateverNameTheFileHas) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "12345");
  fs::create_hard_link(path, folder.path() / "twin.txt");
  read_file(path);
  struct ::stat twin {
  }, stranger{};
  ASSERT_EQ(::stat((folder.path() / "twin.txt").c_str(), &twin), 0);
  ASSERT_EQ(::stat("/dev/null", &stranger), 0);
  EXPECT_TRUE(was_read(twin));
  EXPECT_FALSE(was_read(stranger));
  EXPECT_EQ(files_read().back(), path);
}

TEST(ReadFile, TellsAMissingFileFromAFolder) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(io_error_of([&] { read_file(folder.path() / "none"); }), "No such file"));
  EXPECT_TRUE(contains(io_error_of([&] { read_file(folder.path()); }), "folder"));
}

TEST(ReadFile, RefusesMoreThanItsLimit) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "12345");
  EXPECT_EQ(read_file(path, 5), "12345");
  EXPECT_TRUE(contains(io_error_of([&] { read_file(path, 4); }), "5 bytes"));
}

}  // namespace
}  // namespace palpation
