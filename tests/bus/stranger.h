// Another participant on the bus, made only with the C API, like another program.
#pragma once

#include <memory>
#include <string>

#include <dds/dds.h>

#include "bus/entity.h"
#include "idl/hello_world.h"

namespace understudy::bus {

using Hello = HelloWorldData_Msg;

struct StrangerQos {
  bool reliable = true;
  int depth = 1;  // 0: keep all
  dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;

  std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> Make() const {
    std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(), &dds_delete_qos);
    dds_qset_reliability(qos.get(),
                         reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_MSECS(100));
    dds_qset_history(qos.get(), depth == 0 ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, depth);
    dds_qset_data_representation(qos.get(), 1, &representation);
    return qos;
  }
};

class Stranger {
 public:
  // Joins a domain of this process, in which messages do not use the network.
  explicit Stranger(int domain)
      : participant_(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                     "create a stranger") {}

  Entity Writes(const char* topic, const StrangerQos& qos = {}) const {
    return Entity(
        dds_create_writer(participant_.handle(), MakeTopic(topic), qos.Make().get(), nullptr),
        "create the stranger's writer");
  }
  Entity Reads(const char* topic, const StrangerQos& qos = {}) const {
    return Entity(
        dds_create_reader(participant_.handle(), MakeTopic(topic), qos.Make().get(), nullptr),
        "create the stranger's reader");
  }
  int handle() const { return participant_.handle(); }

 private:
  dds_entity_t MakeTopic(const char* topic) const {
    return dds_create_topic(participant_.handle(), &HelloWorldData_Msg_desc, topic, nullptr,
                            nullptr);
  }

  Entity participant_;
};

// Joins the ports of domain `domain` under the name of domain `alias`, so that messages between the
// two go over the network although both live in this process.
inline Entity JoinOverTheNetwork(int domain, int alias) {
  const std::string xml =
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
      "</Interfaces></General><Discovery><ExternalDomainId>" +
      std::to_string(domain) + "</ExternalDomainId></Discovery></Domain></CycloneDDS>";
  return Entity(dds_create_domain(static_cast<dds_domainid_t>(alias), xml.c_str()),
                "join as alias");
}

}  // namespace understudy::bus
