// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFViewTracer.h"

#include "PathTracing/RadianceCache/cslfCacheCheck.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfDescription.h"

#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>

#include <glm/geometric.hpp>

#include <algorithm>

vtkStandardNewMacro(vtkCSLFViewTracer);
vtkCxxSetSmartPointerMacro(vtkCSLFViewTracer, Camera, vtkCamera);

namespace
{
/// Transforms normalised device coordinates to the world.
class ViewToWorld
{
public:
  ViewToWorld(vtkCamera* camera, double aspect)
  {
    this->Inverse->DeepCopy(camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0));
    this->Inverse->Invert();
  }

  glm::dvec3 Point(double x, double y, double z) const
  {
    const double view[4] = { x, y, z, 1.0 };
    double world[4];
    this->Inverse->MultiplyPoint(view, world);
    return glm::dvec3(world[0], world[1], world[2]) / world[3];
  }

private:
  vtkNew<vtkMatrix4x4> Inverse;
};

/// The camera with a clipping range that suits a scene of any size. The range does not change the
/// rays, but with VTK's default they would be inexact in scenes of a hundred million units or more.
vtkSmartPointer<vtkCamera> FitRange(vtkCamera* camera, const cslf::SceneFrame& frame)
{
  if (camera->GetUseExplicitProjectionTransformMatrix())
  {
    return camera;
  }
  double place[3];
  camera->GetPosition(place);
  const double distance =
    std::max(glm::length(glm::dvec3(place[0], place[1], place[2]) - frame.Center), frame.Radius);
  auto fitted = vtkSmartPointer<vtkCamera>::New();
  fitted->DeepCopy(camera);
  fitted->SetClippingRange(0.5 * distance, 1.5 * distance);
  return fitted;
}

/// The rays of the picture's pixels: from the camera's plane through the near plane to the far
/// plane.
cslf::RayGrid MakeRays(vtkCamera* given, int width, int height, const cslf::SceneFrame& frame)
{
  const vtkSmartPointer<vtkCamera> camera = FitRange(given, frame);
  const ViewToWorld toWorld(camera, static_cast<double>(width) / height);
  const glm::dvec3 position(
    camera->GetPosition()[0], camera->GetPosition()[1], camera->GetPosition()[2]);
  const glm::dvec3 normal(camera->GetDirectionOfProjection()[0],
    camera->GetDirectionOfProjection()[1], camera->GetDirectionOfProjection()[2]);
  struct Line
  {
    glm::dvec3 Start;
    glm::dvec3 End;
  };
  const auto makeLine = [&](double x, double y) -> Line
  {
    const glm::dvec3 nearPoint = toWorld.Point(x, y, -1.0);
    const glm::dvec3 farPoint = toWorld.Point(x, y, 1.0);
    const glm::dvec3 path = farPoint - nearPoint;
    const double back = glm::dot(nearPoint - position, normal) / glm::dot(path, normal);
    return { frame.PointToScene(nearPoint - back * path), frame.PointToScene(farPoint) };
  };
  const Line corner = makeLine(-1.0, -1.0);
  const Line right = makeLine(-1.0 + 2.0 / width, -1.0);
  const Line up = makeLine(-1.0, -1.0 + 2.0 / height);
  cslf::RayGrid rays;
  rays.Origin = corner.Start;
  rays.OriginX = right.Start - corner.Start;
  rays.OriginY = up.Start - corner.Start;
  rays.Direction = corner.End - corner.Start;
  rays.DirectionX = right.End - right.Start - rays.Direction;
  rays.DirectionY = up.End - up.Start - rays.Direction;
  return rays;
}
}

vtkCSLFViewTracer::vtkCSLFViewTracer() = default;

vtkCSLFViewTracer::~vtkCSLFViewTracer() = default;

vtkMTimeType vtkCSLFViewTracer::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Camera ? std::max(time, this->Camera->GetMTime()) : time;
}

vtkCamera* vtkCSLFViewTracer::GetCamera()
{
  return this->Camera;
}

bool vtkCSLFViewTracer::CheckParameters()
{
  if (!this->Camera)
  {
    vtkErrorMacro("Camera is not set.");
    return false;
  }
  if (this->Size[0] < 1 || this->Size[1] < 1)
  {
    vtkErrorMacro("Size must be at least 1 x 1.");
    return false;
  }
  if (this->ColorType != VTK_UNSIGNED_CHAR && this->ColorType != VTK_FLOAT)
  {
    vtkErrorMacro("ColorType must be VTK_UNSIGNED_CHAR or VTK_FLOAT.");
    return false;
  }
  return true;
}

int vtkCSLFViewTracer::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->CheckParameters())
  {
    return 0;
  }
  const int extent[6] = { 0, this->Size[0] - 1, 0, this->Size[1] - 1, 0, 0 };
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  info->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->ColorType, 4);
  return 1;
}

int vtkCSLFViewTracer::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const cslf::BuiltScene* scene = this->UpdateScene(inputVector);
  if (!scene)
  {
    output->Initialize();
    return cslf::IsAborted(this) ? 1 : 0;
  }
  // The array first, which may be too large: some versions of VTK store the coordinates of images.
  const auto colors = cslf::MakeArray(cslf::MakeChannel(cslf::KnownChannel::Color, this->ColorType),
    static_cast<vtkIdType>(this->Size[0]) * this->Size[1]);
  output->SetDimensions(this->Size[0], this->Size[1], 1);
  output->GetPointData()->SetScalars(colors);

  const cslf::RayGrid rays = MakeRays(this->Camera, this->Size[0], this->Size[1], scene->Frame);
  const cslf::CheckedPicture picture{ this->Size[0], this->Size[1], 1, 1,
    [&rays](int, int) { return rays; } };
  if (!this->Render(picture, 0, 1, cslf::ViewpointSamples(output), false, "Tracing the picture"))
  {
    output->Initialize();
    return 1;
  }
  vtkNew<vtkStringArray> sampling;
  sampling->SetName(SAMPLING_NAME());
  sampling->InsertNextValue(this->DescribeSampling());
  output->GetFieldData()->AddArray(sampling);
  return 1;
}

void vtkCSLFViewTracer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Camera: " << this->Camera.Get() << "\n";
  os << indent << "Size: " << this->Size[0] << " " << this->Size[1] << "\n";
  os << indent << "ColorType: " << this->ColorType << "\n";
}
