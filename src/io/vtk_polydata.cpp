#include "io/vtk_polydata.h"

#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>

#include "io/length_scale.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

void remember_message(vtkObject*, unsigned long, void* message, void* text) {
  if (text != nullptr) *static_cast<std::string*>(message) = static_cast<const char*>(text);
}

void ignore_message(vtkObject*, unsigned long, void*, void*) {}

// Whoever listens to an object's messages keeps VTK from printing them.
void listen(vtkObject& speaker, void (*callback)(vtkObject*, unsigned long, void*, void*),
            std::string& message) {
  vtkNew<vtkCallbackCommand> listener;
  listener->SetCallback(callback);
  listener->SetClientData(&message);
  speaker.AddObserver(vtkCommand::ErrorEvent, listener);
  speaker.AddObserver(vtkCommand::WarningEvent, listener);
}

// VTK's error code is the system's last error, which on a full disk is that of cleaning up, so the
// message counts. It comes on several lines, after the place in VTK's source and the object that
// speaks.
std::string reason_of(const std::string& message) {
  const std::size_t object_end = message.find("): ");
  if (object_end == std::string::npos) return "the disk is full or failing";
  const std::size_t begin = object_end + 3;
  return message.substr(begin, message.find('\n', begin) - begin);
}

// VTK's writer reports success even where the file could not be opened: what counts is the error
// code. Its messages are caught, or it would print them.
void run(vtkXMLPolyDataWriter& writer, vtkPolyData& polydata, const std::string& name) {
  std::string message;
  listen(writer, remember_message, message);
  listen(*writer.GetExecutive(), ignore_message, message);
  writer.SetInputData(&polydata);
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToLZ4();
  const int written = writer.Write();
  if (written == 1 && writer.GetErrorCode() == vtkErrorCode::NoError && message.empty()) return;
  throw WriteError(name + ": not written: " + reason_of(message));
}

void add_text(vtkPolyData& polydata, const char* name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(text);
  polydata.GetFieldData()->AddArray(array);
}

}  // namespace

vtkSmartPointer<vtkPoints> vtk_points(vtkIdType count) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  return points;
}

vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name, const Field& field) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfTuples(field.size());
  std::copy(field.begin(), field.end(), array->GetPointer(0));
  return array;
}

void tell_coordinates(vtkPolyData& polydata, LengthUnit unit, Frame frame) {
  add_text(polydata, "UNIT", name_of(unit));
  add_text(polydata, "FRAME", name_of(frame));
  if (frame != Frame::Mesh) add_text(polydata, "SPACE", name_of(frame));
}

void write_polydata(const fs::path& path, vtkPolyData& polydata) {
  write_atomically(path, [&](const fs::path& temporary) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(temporary.c_str());
    run(*writer, polydata, path.string());
  });
}

std::string bytes_of(const std::string& name, vtkPolyData& polydata) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  run(*writer, polydata, name);
  return writer->GetOutputString();
}

}  // namespace palpation
