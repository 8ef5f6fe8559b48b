"""Files for simulators: URDF and MuJoCo's MJCF, with the meshes they refer to."""
