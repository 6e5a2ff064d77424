// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldStore.h"

#include "Pipeline/cslfArrayLayout.h"
#include "cslfFieldArrays.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseKey.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>

#include <utility>

namespace cslf
{
namespace
{
class ImageStore : public FieldStore
{
public:
  ImageStore(const Description& field, vtkImageData* image)
    : FieldStore(field, cslf::GetMissing(image, field.Grid.GetSlices()))
    , Whole(ToAOS(image, image->GetExtent()[4], image->GetExtent()[5]))
  {
  }

  void Prefetch(const std::vector<int>&) override {}
  void Wait() override {}
  bool IsReady(int) override { return true; }

  ViewpointSamples Get(int slice) override
  {
    const auto texels = static_cast<vtkIdType>(this->GetDescription().Grid.GetStripTexels());
    for (const ChannelId id : ChannelIds)
    {
      // Who made the arrays may have resized them since.
      vtkDataArray* array = this->Whole.GetArray(id);
      if (array && array->GetNumberOfTuples() < (slice + 1) * texels)
      {
        return {};
      }
    }
    return this->Whole.At(slice * texels);
  }

  void Sort(std::vector<int>&) override {}

private:
  const ViewpointSamples Whole;
};

/// What an output's information holds.
class Loan : public vtkObject
{
public:
  static Loan* New();
  vtkTypeMacro(Loan, vtkObject);

  StoreLender Lender;
};
vtkStandardNewMacro(Loan);

vtkInformationObjectBaseKey* LoanKey()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("FIELD_STORE", "cslfFieldStore");
  return key;
}
}

FieldStore::FieldStore(const Description& field, std::vector<int> missing)
  : Field(field)
  , Missing(std::move(missing))
{
}

FieldStore::~FieldStore() = default;

std::shared_ptr<FieldStore> MakeStore(const Description& field, vtkImageData* image)
{
  return std::make_shared<ImageStore>(field, image);
}

void LendStore(vtkInformation* output, StoreLender lender)
{
  vtkNew<Loan> loan;
  loan->Lender = std::move(lender);
  output->Set(LoanKey(), loan);
}

bool IsStoreLent(vtkInformation* output)
{
  return output->Has(LoanKey()) != 0;
}

std::shared_ptr<FieldStore> BorrowStore(vtkInformation* output)
{
  auto* loan = Loan::SafeDownCast(output->Get(LoanKey()));
  return loan ? loan->Lender() : nullptr;
}
}
