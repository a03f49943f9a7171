/// Lines and dots that face the viewer, as polygons of a scene.
#pragma once

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "draw/sheet.h"
#include "palpation/base/types.h"

namespace palpation::draw {

// Polygons that face the viewer.
class Shapes {
 public:
  Shapes() { points_->SetDataTypeToDouble(); }

  void disc(const Vec3& centre, double radius) {
    for (const Pixel& corner : circle(centre.head<2>(), radius))
      corners_.push_back(points_->InsertNextPoint(corner.x(), corner.y(), centre.z()));
    close();
  }

  void strip(const Vec3& from, const Vec3& to, double width) {
    const Vec3 along = to - from;
    const Vec3 across = Vec3(-along.y(), along.x(), 0.0);
    if (across.norm() == 0.0) return;
    const Vec3 half = across.normalized() * (width / 2.0);
    for (const Vec3& corner :
         {Vec3(from - half), Vec3(to - half), Vec3(to + half), Vec3(from + half)}) {
      corners_.push_back(points_->InsertNextPoint(corner.data()));
    }
    close();
  }

  void line(const std::vector<Vec3>& points, double width) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      strip(points[i], points[i + 1], width);
      if (i > 0) disc(points[i], width / 2.0);
    }
    const bool closed = points.size() > 2 && points.front() == points.back();
    if (closed) disc(points.front(), width / 2.0);
  }

  vtkSmartPointer<vtkPolyData> polygons() const {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points_);
    result->SetPolys(cells_);
    return result;
  }

 private:
  void close() {
    cells_->InsertNextCell(static_cast<vtkIdType>(corners_.size()), corners_.data());
    corners_.clear();
  }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  std::vector<vtkIdType> corners_;
};

/// Lines where the scalars of a part are whole numbers, lifted towards the viewer.
vtkSmartPointer<vtkPolyData> hatching(vtkPolyData& part, double lift, double width);

}  // namespace palpation::draw
