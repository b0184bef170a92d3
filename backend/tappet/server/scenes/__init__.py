"""3D scenes of a project, fed with values of a runtime."""
