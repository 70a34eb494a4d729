#include "bus/qos.h"

#include <array>

namespace understudy::bus {
namespace {

QosPtr CommonQos(int depth) {
  QosPtr qos(dds_create_qos());
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), depth == kKeepAll ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST,
                   depth);
  constexpr std::array<dds_data_representation_id_t, 2> kRepresentations = {
      DDS_DATA_REPRESENTATION_XCDR1, DDS_DATA_REPRESENTATION_XCDR2};  // a writer uses the first
  dds_qset_data_representation(qos.get(), kRepresentations.size(), kRepresentations.data());
  return qos;
}

}  // namespace

QosPtr WriterQos() {
  QosPtr qos = CommonQos(1);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  return qos;
}

QosPtr ReaderQos(const ReaderOptions& options) {
  QosPtr qos = CommonQos(options.depth);
  dds_qset_reliability(
      qos.get(), options.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  if (options.foreign_only) dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

}  // namespace understudy::bus
