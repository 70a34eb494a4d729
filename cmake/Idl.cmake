# understudy_idl_library(NAME file.idl...): one static library per IDL family, compiled by the idlc that Cyclone DDS brings.
