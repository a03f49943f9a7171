#include "palpation/io/atomic_file.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(WriteAtomically, WritesTheFileBehindASymbolicLink) {
  const TemporaryFolder folder;
  const fs::path target = folder.file("target.txt", "old");
  fs::create_symlink(target, folder.path() / "link.txt");
  write_atomically(folder.path() / "link.txt", "new");
  EXPECT_EQ(read_file(target), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.txt"));
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
