// A fuzz target without libFuzzer: runs it on files, and on random mutants of them.
//   fuzz_TARGET [--mutants N] [--seed S] [--truncate] FILE_OR_FOLDER ...
// An input that breaks a promise, crashes or takes longer than two seconds is written to
// ./find-<number> and ends the program.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/target.h"
#include "palpation/base/random.h"

namespace {

namespace fs = std::filesystem;
using palpation::Random;

constexpr unsigned kSeconds = 2;

/// What runs now, for the signal handler.
const std::string* current = nullptr;
long runs = 0;

void keep_find(int signal) {
  const std::string name = "find-" + std::to_string(runs);
  std::ofstream(name, std::ios::binary) << *current;
  std::fprintf(stderr, "%s on input %ld, kept as ./%s\n",
               signal == SIGALRM ? "no end after two seconds" : strsignal(signal), runs,
               name.c_str());
  std::_Exit(1);
}

void run(const std::string& input) {
  current = &input;
  ++runs;
  ::alarm(kSeconds);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  ::alarm(0);
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void collect(const fs::path& path, std::vector<std::string>& inputs) {
  if (!fs::is_directory(path)) return inputs.push_back(content(path));
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) inputs.push_back(content(file));
}

/// Bytes and words that make trouble more often than others.
std::string trouble(Random& random) {
  static const std::vector<std::string> words{"-1",
                                              "0",
                                              "1e400",
                                              "1e-400",
                                              "nan",
                                              "inf",
                                              "2147483648",
                                              "4294967295",
                                              "99999999999999999999",
                                              "-0",
                                              ",",
                                              ".",
                                              "#",
                                              "\n",
                                              "\r",
                                              "\t",
                                              "\"",
                                              "<",
                                              ">",
                                              "/",
                                              "\\",
                                              "{",
                                              "}",
                                              "[",
                                              "]",
                                              "(",
                                              ")",
                                              "1,5",
                                              std::string(1, '\0'),
                                              "\xFF\xFF\xFF\xFF",
                                              std::string(4, '\0'),
                                              "\x7F\xFF\xFF\xFF",
                                              "\xEF\xBB\xBF"};
  return words[static_cast<std::size_t>(random.below(static_cast<int>(words.size())))];
}

std::size_t position(const std::string& text, Random& random) {
  return static_cast<std::size_t>(random.below(static_cast<int>(text.size()) + 1));
}

void mutate(std::string& text, const std::vector<std::string>& inputs, Random& random) {
  const std::size_t at = position(text, random);
  const std::size_t length = std::min(static_cast<std::size_t>(random.below(16)), text.size() - at);
  switch (random.below(7)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
      break;
    case 2:
      text.erase(at, length);
      break;
    case 3:
      text.insert(position(text, random), text.substr(at, length));
      break;
    case 4:
      text.replace(at, length, trouble(random));
      break;
    case 5:
      text.resize(at);
      break;
    default: {
      const std::string& other =
          inputs[static_cast<std::size_t>(random.below(static_cast<int>(inputs.size())))];
      text = text.substr(0, at) + other.substr(position(other, random));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  long mutants = 0;
  std::uint64_t seed = 1;
  bool truncate = false;
  std::vector<std::string> inputs;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--mutants" && i + 1 < argc) {
      mutants = std::atol(argv[++i]);
    } else if (argument == "--seed" && i + 1 < argc) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (argument == "--truncate") {
      truncate = true;
    } else if (fs::exists(argument)) {
      collect(argument, inputs);
    } else {
      std::fprintf(
          stderr,
          "usage: %s [--mutants N] [--seed S] [--truncate] FILE_OR_FOLDER ...; there is no %s\n",
          argv[0], argument.c_str());
      return 2;
    }
  }
  if (inputs.empty()) {
    std::fprintf(stderr, "%s: no inputs\n", argv[0]);
    return 2;
  }
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM})
    std::signal(signal, keep_find);
  for (const std::string& input : inputs) {
    run(input);
    for (std::size_t length = 0; truncate && length < input.size(); ++length)
      run(input.substr(0, length));
  }
  Random random(seed);
  for (long i = 0; i < mutants; ++i) {
    std::string mutant =
        inputs[static_cast<std::size_t>(random.below(static_cast<int>(inputs.size())))];
    for (int steps = 1 + random.below(4); steps > 0; --steps) mutate(mutant, inputs, random);
    run(mutant);
  }
  std::printf("%ld inputs, no find\n", runs);
  return 0;
}
