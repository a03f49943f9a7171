#include "io/vtp_file.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// zlib, the strongest of VTK's compressors, makes at most 1032 bytes of one: more numbers than that cannot be in a file.
constexpr std::int64_t kMostBytesPerByte = 1032;

/// What VTK complained of first, on one line; empty as long as it did not.
class Complaint {
 public:
  void take(const char* text) {
    if (first_.empty()) first_ = text != nullptr ? one_line(text) : "no reason given";
  }
  const std::string& first() const { return first_; }

 private:
  /// VTK's messages say "ERROR: In <source file>, line n\n<class> (<address>): <text>": only the text is for the user.
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    const std::size_t start = text.find("): ");
    text = start == std::string::npos ? text : text.substr(start + 3);
    text.erase(text.find_last_not_of(' ') + 1);
    return text.empty() ? "no reason given" : text;
  }

  std::string first_;
};

/// Stands in for VTK's window: hears the objects inside the reader, which nobody can observe.
class ListeningWindow : public vtkOutputWindow {
 public:
  static ListeningWindow* New();
  void listen_for(Complaint& complaint) { complaint_ = &complaint; }
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { hear(text); }
  void DisplayWarningText(const char* text) override { hear(text); }
  void DisplayGenericWarningText(const char* text) override { hear(text); }
  void DisplayDebugText(const char*) override {}

 private:
  void hear(const char* text) {
    if (complaint_ != nullptr) complaint_->take(text);
  }
  Complaint* complaint_ = nullptr;
};
vtkStandardNewMacro(ListeningWindow)

    /// VTK's window and log are one for the process, so reading takes turns. The log would print to stderr besides.
    class Silence {
 public:
  explicit Silence(Complaint& complaint)
      : lock_(mutex()), window_before_(vtkOutputWindow::GetInstance()), verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkNew<ListeningWindow> window;
    window->listen_for(complaint);
    vtkOutputWindow::SetInstance(window);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkLogger::SetStderrVerbosity(verbosity_before_);
    vtkOutputWindow::SetInstance(window_before_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex the_mutex;
    return the_mutex;
  }
  std::lock_guard<std::mutex> lock_;
  vtkSmartPointer<vtkOutputWindow> window_before_;
  vtkLogger::Verbosity verbosity_before_;
};

vtkSmartPointer<vtkCallbackCommand> observer_for(Complaint& complaint) {
  vtkSmartPointer<vtkCallbackCommand> command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetClientData(&complaint);
  command->SetCallback(
      [](vtkObject*, unsigned long, void* client, void* text) { static_cast<Complaint*>(client)->take(static_cast<const char*>(text)); });
  return command;
}

bool is_name_character(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// Before VTK allocates: every count in the XML must fit into the bytes of the file.
class CountScan {
 public:
  explicit CountScan(const MeshSource& source) : source_(source) {}

  void check() const {
    const auto bytes = static_cast<std::int64_t>(source_.bytes.size());
    for (const char* name : {"NumberOfPoints", "NumberOfPolys", "NumberOfStrips", "NumberOfLines", "NumberOfVerts", "NumberOfTuples"}) {
      check_attribute(name, bytes * kMostBytesPerByte);
    }
    check_attribute("NumberOfComponents", 4096);
    check_attribute("offset", bytes);
  }

 private:
  /// Reads name="number" wherever it stands; raw appended data holds such text only by design, and then an error is due.
  void check_attribute(std::string_view name, std::int64_t most) const {
    for (std::size_t at = source_.bytes.find(name); at != std::string_view::npos; at = source_.bytes.find(name, at + name.size())) {
      if (at == 0 || is_name_character(source_.bytes[at - 1])) continue;
      const std::optional<std::string_view> text = value_behind(at + name.size());
      if (!text) continue;
      const std::optional<std::int64_t> value = parse_integer(*text);
      if (value && *value >= 0 && *value <= most) continue;
      source_.fail_at_byte(at, std::string(name) + " = " + in_quotes(*text) + " must be a whole number from 0 to " + std::to_string(most) +
                                   " in a file of this size");
    }
  }

  std::optional<std::string_view> value_behind(std::size_t at) const {
    constexpr std::string_view kBlank = " \t\r\n";
    at = source_.bytes.find_first_not_of(kBlank, at);
    if (at == std::string_view::npos || source_.bytes[at] != '=') return std::nullopt;
    at = source_.bytes.find_first_not_of(kBlank, at + 1);
    if (at == std::string_view::npos || (source_.bytes[at] != '"' && source_.bytes[at] != '\'')) return std::nullopt;
    const std::size_t end = source_.bytes.find(source_.bytes[at], at + 1);
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view text = source_.bytes.substr(at + 1, end - at - 1);
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    return text.substr(0, text.find_last_not_of(kBlank) + 1);
  }

  const MeshSource& source_;
};

vtkSmartPointer<vtkPolyData> parsed(const MeshSource& source, Complaint& complaint) {
  const vtkSmartPointer<vtkCallbackCommand> observer = observer_for(complaint);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->AddObserver(vtkCommand::WarningEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(source.bytes));
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_poly_data(const MeshSource& source) {
  CountScan(source).check();
  Complaint complaint;
  const Silence silence(complaint);
  try {
    vtkSmartPointer<vtkPolyData> poly = parsed(source, complaint);
    if (!complaint.first().empty()) source.fail("not a sound VTP file: " + complaint.first());
    if (poly == nullptr) source.fail("not a sound VTP file");
    return poly;
  } catch (const std::bad_alloc&) {
    source.fail("a count or size in the file asks for more memory than there is");
  } catch (const std::length_error&) {
    source.fail("a count or size in the file is beyond any memory");
  }
}

void check_arrays(const MeshSource& source, vtkFieldData* arrays, vtkIdType tuples, const std::string& where) {
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i) {
    vtkAbstractArray* array = arrays->GetAbstractArray(i);
    const std::string name = array->GetName() != nullptr ? array->GetName() : "";
    if (name.empty()) source.fail("array " + std::to_string(i) + " of the " + where + " has no name");
    if (array->GetNumberOfTuples() == tuples) continue;
    source.fail("array " + in_quotes(name) + " of the " + where + " has " + std::to_string(array->GetNumberOfTuples()) + " entries, not " +
                std::to_string(tuples));
  }
}

VtpCells::VtpCells(const MeshSource& source, vtkCellArray* cells, std::string name)
    : source_(source), offsets_(cells->GetOffsetsArray()), connectivity_(cells->GetConnectivityArray()), name_(std::move(name)) {
  for (vtkIdType cell = 0; cell < count(); ++cell) {
    if (offset(cell) >= 0 && offset(cell) <= offset(cell + 1)) continue;
    source.fail("offsets of " + name_ + " must not decrease, but they do at cell " + std::to_string(cell));
  }
  if (count() > 0 && offset(count()) > connectivity_->GetNumberOfValues())
    source.fail("offsets of " + name_ + " point behind the connectivity");
}

vtkIdType VtpCells::count() const { return std::max<vtkIdType>(offsets_->GetNumberOfValues() - 1, 0); }

vtkIdType VtpCells::size(vtkIdType cell) const { return offset(cell + 1) - offset(cell); }

int VtpCells::corner(vtkIdType cell, vtkIdType i, std::size_t vertices) const {
  const double index = connectivity_->GetComponent(offset(cell) + i, 0);
  if (index >= 0.0 && index < static_cast<double>(vertices)) return static_cast<int>(index);
  source_.fail("cell " + std::to_string(cell) + " of " + name_ + ": vertex index " + text_of(index) + " is out of range 0 to " +
               std::to_string(static_cast<std::int64_t>(vertices) - 1));
}

// Indices up to 2^53 pass through a double unharmed, and larger ones stay out of range.
vtkIdType VtpCells::offset(vtkIdType cell) const { return static_cast<vtkIdType>(offsets_->GetComponent(cell, 0)); }

}  // namespace palpation
