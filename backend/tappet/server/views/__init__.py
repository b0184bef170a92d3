"""Pages of 3D views behind the server's own address and login."""
