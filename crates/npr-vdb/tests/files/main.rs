//! Files of volumes: generated ones, those that OpenVDB wrote, and those beside the checkout.

mod openvdb;
mod samples;
mod shared_volumes;
