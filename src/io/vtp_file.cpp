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
#include <stdexcept>
#include <string>
#include <utility>

#include "io/number_text.h"
#include "io/vtp_scan.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

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

vtkSmartPointer<vtkPolyData> parsed(const std::string& bytes, Complaint& complaint) {
  const vtkSmartPointer<vtkCallbackCommand> observer = observer_for(complaint);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->AddObserver(vtkCommand::WarningEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_poly_data(const MeshSource& source) {
  const std::string bytes = vetted_vtp(source);
  Complaint complaint;
  const Silence silence(complaint);
  try {
    vtkSmartPointer<vtkPolyData> poly = parsed(bytes, complaint);
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
